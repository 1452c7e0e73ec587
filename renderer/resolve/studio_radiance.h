#pragma once

#include <glm/glm.hpp>

#include "protocol/spec/frame_spec.h"
#include "renderer/core/linear_algebra.h"

namespace gnomon {

/// Radiance of the studio where renderer/shaders/shared/surroundings.h has 1: linear RGB, in the unit of the lights.
/// For a frame that the studio lights.
inline glm::dvec3 studioRadiance(const FrameSpec& spec) {
  return toVector(spec.ambient.color) * (spec.ambient.intensity * spec.environment.intensity.value_or(1));
}

} // namespace gnomon
