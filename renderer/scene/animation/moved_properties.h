#pragma once

#include <nlohmann/json_fwd.hpp>

#include "protocol/base/result.h"
#include "renderer/scene/animation/motion.h"

namespace gnomon {

/// The parts of a document that properties of animations lie in: materials, cameras and lights.
nlohmann::json propertiesOf(const nlohmann::json& document);

/// These as an animation has them at a time. What a spline throws beyond a property's range is held at its end; a
/// problem where that is not in the range itself, or where two members no longer fit each other.
Result<nlohmann::json> movedProperties(const nlohmann::json& rest, const Animation& animation, double timeSeconds);

} // namespace gnomon
