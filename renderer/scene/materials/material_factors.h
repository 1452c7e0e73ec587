#pragma once

#include <array>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "renderer/scene/findings.h"
#include "renderer/scene/scene.h"

namespace gnomon {

/// A material as its JSON says it, but for the textures. It has passed the schema check. `name` says in warnings which
/// one it is.
Material readFactors(const nlohmann::json& source, const std::string& name, Findings& findings);

/// What a material's JSON says of the textures of texturesOf(), in that order; nullptr = there is none.
std::array<const nlohmann::json*, 5> textureInfosOf(const nlohmann::json& source);

/// A loaded material with what its JSON says now: the textures stay, how they are laid does not.
Material repainted(const Material& loaded, const nlohmann::json& source);

} // namespace gnomon
