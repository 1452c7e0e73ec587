#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "renderer/cpu/raster/depth_buffer.h"

namespace gnomon::cpu {

/// Depths of some pixels, reversed: 1 nearest, 0 = nothing is shown.
struct DepthEnds {
  float nearest = 0;
  float farthest = 2; ///< of what is shown; 2 = nothing is
  float least = 2;    ///< 0 = some sample shows nothing
};

/// Of each square of `side` pixels, a multiple of kBlockSide, from left to right; of the rows from y0 to y1, which
/// belongs to them.
std::vector<DepthEnds> depthEnds(const DepthBuffer& buffer, int y0, int y1, int side);

/// The same of the surfaces of some slots, `slots` (a byte each): whatever else is shown counts as nothing. REQUIRES: a
/// numbered buffer.
std::vector<DepthEnds> depthEnds(const DepthBuffer& buffer, int y0, int y1, int side,
                                 std::span<const std::uint8_t> slots);

} // namespace gnomon::cpu
