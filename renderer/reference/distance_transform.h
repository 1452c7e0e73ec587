#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace gnomon {

/// Exact Euclidean distance in pixels from the centre of each pixel to that of the nearest one marked in `marks` (not
/// 0), row by row; infinity where none is marked. Takes time in proportion to the pixels.
std::vector<float> distancesTo(std::span<const std::uint8_t> marks, int width, int height);

} // namespace gnomon
