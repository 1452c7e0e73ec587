#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "renderer/cpu/raster/depth_buffer.h"
#include "renderer/shadow/shadow_plan.h"

namespace gnomon::cpu {

/// How a tile's depths become blurred moments.
struct MomentBlur {
  int kind = 0;       ///< GNOMON_FILTER_VSM, _EVSM or _MSM
  glm::vec2 reach{0}; ///< texels to each side that the box takes whole, along x and y
  float nearest = 0;  ///< distances of a perspective tile's ends, metres; 0 0 for parallel light
  float farthest = 0;
};

MomentBlur momentBlur(const ShadowTile& tile);

/// The blurred moments of a tile's texels, row by row from the BOTTOM; a box along x, then along y, on all cores. What
/// lies beyond the tile is its outermost texel.
std::vector<glm::vec4> blurredMoments(const DepthBuffer& depths, const MomentBlur& blur);

} // namespace gnomon::cpu
