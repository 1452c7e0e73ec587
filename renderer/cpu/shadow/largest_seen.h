#pragma once

#include <cstdint>
#include <vector>

#include "renderer/cpu/raster/depth_buffer.h"

namespace gnomon::cpu {

/// Triangles that a picture shows much of, by their numbers, in order: at most 16, each of which fills some squares of
/// the picture. None where all of them together fill little of it.
std::vector<std::uint32_t> largestSeen(const DepthBuffer& surfaces);

} // namespace gnomon::cpu
