#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>

#include "renderer/cpu/raster/texel_marks.h"
#include "renderer/cpu/shadow/shadow_maps.h"

namespace gnomon::cpu {

/// A point that light is asked for, and where the light is.
struct AskedPoint {
  glm::vec3 relative{0};
  glm::vec3 normal{0, 0, 1};
  float viewDepth = 0;
  unsigned groupBit = 1;
  glm::vec2 place{0.5f};
  unsigned samples = 1;
  glm::vec3 toLight{0, 0, 1};
  std::uint32_t triangle = 0;
  glm::vec2 weights{0};
};

// Sixteen points at a time; `points` and `out` are of one length, which may be any.

/// shadowVisibility of light 0.
void visibilitiesByLanes(const ShadowMaps& maps, std::span<const AskedPoint> points, float* out);
/// markMapReads of light 0.
void markByLanes(const ShadowMaps& maps, std::span<const AskedPoint> points, std::span<TexelMarks> marks);

} // namespace gnomon::cpu
