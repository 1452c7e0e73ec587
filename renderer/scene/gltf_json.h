#pragma once

#include <nlohmann/json.hpp>
#include <string>

/// What many readers of the file's JSON ask of an object. It has passed the schema check.
namespace gnomon {

/// nullptr = the object has no such extension.
const nlohmann::json* extensionOf(const nlohmann::json& object, const char* name);

/// Its name; empty where it has none.
std::string nameOf(const nlohmann::json& object);

} // namespace gnomon
