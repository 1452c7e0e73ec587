#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "renderer/scene/findings.h"

namespace gnomon {

/// Refuses glTF versions other than 2.x.
void checkVersion(const nlohmann::json& document, Findings& findings);

/// Refuses every required extension that is not supported; warns of those that are used.
void checkExtensions(const nlohmann::json& document, Findings& findings);

/// Of these names those that are not supported, in their order.
std::vector<std::string> unsupportedOf(const std::vector<std::string>& names);

} // namespace gnomon
