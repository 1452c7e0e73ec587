#pragma once

#include <glm/glm.hpp>
#include <span>

#include "renderer/cpu/raster/depth_buffer.h"
#include "renderer/cpu/raster/texel_marks.h"
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

/// Texels to each side, along x and y, whose depths a blurred one is made of.
glm::ivec2 readAround(const MomentBlur& blur);

/// Blurs the moments of the texels that are `wanted`, on all cores: a box along x, then along y. What lies beyond the
/// tile is its outermost texel. `moments`: of all of the tile's texels, row by row from the BOTTOM; others near the
/// wanted ones are blurred with them, of whatever the depths around them hold. A texel comes out the same whichever
/// others are wanted.
void blurMoments(const DepthBuffer& depths, const MomentBlur& blur, const TexelMarks& wanted,
                 std::span<glm::vec4> moments);

} // namespace gnomon::cpu
