#pragma once

#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/scene/findings.h"

namespace gnomon {

/// Refuses glTF versions other than 2.x.
void checkVersion(const nlohmann::json& document, Findings& findings);

/// Refuses every required extension that is not supported; warns of those that are used.
void checkExtensions(const nlohmann::json& document, Findings& findings);

/// The strings of an array member of the root; other values are left to the schema check.
std::set<std::string> namesIn(const nlohmann::json& document, const char* key);

/// Whether what an extension adds is read.
bool isSupported(std::string_view extension);

/// Of these names those that are not supported, in their order.
std::vector<std::string> unsupportedOf(const std::vector<std::string>& names);

/// Checks and repairs every member that Gnomon reads: presence, type, range, and that each index exists; 3.0 becomes 3.
/// A part that is left out becomes an array of the reason and its name (faultOf in document/read_model.h).
void checkSchema(nlohmann::json& document, Findings& findings);

} // namespace gnomon
