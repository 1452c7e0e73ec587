#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

/// What many readers of the file's JSON ask of it.
namespace gnomon {

/// nullptr = the object has no such member.
const nlohmann::json* memberOf(const nlohmann::json& object, std::string_view key);

/// nullptr = the object has no such extension.
const nlohmann::json* extensionOf(const nlohmann::json& object, std::string_view name);

/// Its name; empty where it has none.
std::string nameOf(const nlohmann::json& object);

/// A token of a JSON pointer as an index below `size`; it has no sign and no leading zero (RFC 6901).
std::optional<std::size_t> indexIn(std::string_view token, std::size_t size);

} // namespace gnomon
