#pragma once

#include <nlohmann/json.hpp>

#include "renderer/scene/findings.h"

namespace gnomon {

/// Refuses glTF versions other than 2.x.
void checkVersion(const nlohmann::json& document, Findings& findings);

/// Refuses every required extension that is not supported; warns of those that are used.
void checkExtensions(const nlohmann::json& document, Findings& findings);

} // namespace gnomon
