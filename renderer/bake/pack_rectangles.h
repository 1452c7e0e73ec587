#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "renderer/core/rect.h"

namespace gnomon {

struct RectanglePacking {
  int height = 0;          ///< that is taken, texels
  std::vector<Rect> rects; ///< in the order of the sizes
};

/// Places rectangles side by side and over each other in a strip of this width: the highest first, each as low as it
/// goes on the skyline of those before (Jylaenki, "A Thousand Ways to Pack the Bin", 2010: skyline, bottom left). For
/// rectangles of any size; packSquares wastes nothing where all are squares of powers of two.
/// REQUIRES: no size is empty or wider than the strip.
RectanglePacking packRectangles(std::span<const glm::ivec2> sizes, int width);

} // namespace gnomon
