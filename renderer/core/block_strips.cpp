#include "renderer/core/block_strips.h"

#include <algorithm>

namespace gnomon {

std::vector<BlockStrip> blockStrips(int count, int blockSize, int pixels, const glm::dvec3& axis) {
  constexpr double kMargin = 0.5; // pixels
  const auto at = [&](double pixel) { return axis * (2.0 * pixel / pixels - 1.0); };
  std::vector<BlockStrip> strips;
  for (int i = 0; i < count; ++i) {
    const glm::dvec3 first = at(i * blockSize - kMargin);
    const glm::dvec3 last = at(std::min((i + 1) * blockSize, pixels) + kMargin);
    strips.push_back({glm::min(first, last), glm::max(first, last)});
  }
  return strips;
}

Aabb blockPiece(bool perspective, const glm::dvec3& forward, const BlockStrip& column, const BlockStrip& row,
                double from, double to) {
  const glm::dvec3 low = column.low + row.low;
  const glm::dvec3 high = column.high + row.high;
  // A coordinate is linear in the depth, so its extremes are at the ends.
  if (!perspective) {
    return {low + glm::min(forward * from, forward * to), high + glm::max(forward * from, forward * to)};
  }
  return {glm::min((forward + low) * from, (forward + low) * to),
          glm::max((forward + high) * from, (forward + high) * to)};
}

} // namespace gnomon
