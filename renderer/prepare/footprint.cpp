#include "renderer/prepare/footprint.h"

#include <algorithm>
#include <cmath>

namespace gnomon {

std::optional<Footprint> footprintOf(const CameraView& view, const ReceiverDepths& depths, const Aabb& box) {
  glm::dvec2 low(HUGE_VAL);
  glm::dvec2 high(-HUGE_VAL);
  double nearest = HUGE_VAL;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 p((corner & 1) != 0 ? box.max.x : box.min.x, (corner & 2) != 0 ? box.max.y : box.min.y,
                       (corner & 4) != 0 ? box.max.z : box.min.z);
    const double depth = glm::dot(p, view.forward);
    nearest = std::min(nearest, depth);
    if (depth < view.near || (view.perspective && depth <= 0)) return std::nullopt;
    const double scale = view.perspective ? 1 / depth : 1.0;
    const glm::dvec2 ndc = glm::dvec2(glm::dot(p, view.right), glm::dot(p, view.up)) * scale / view.halfSize;
    low = glm::min(low, ndc);
    high = glm::max(high, ndc);
  }
  // A pixel to each side for rounding; rows count from the top.
  const auto block = [&](double pixel, int count) {
    return static_cast<int>(std::clamp(std::floor(pixel / depths.blockSize), 0.0, count - 1.0));
  };
  Footprint footprint;
  footprint.firstColumn = block((low.x * 0.5 + 0.5) * depths.width - 1, depths.columns);
  footprint.lastColumn = block((high.x * 0.5 + 0.5) * depths.width + 1, depths.columns);
  footprint.firstRow = block((0.5 - high.y * 0.5) * depths.height - 1, depths.rows);
  footprint.lastRow = block((0.5 - low.y * 0.5) * depths.height + 1, depths.rows);
  footprint.nearest = nearest;
  return footprint;
}

} // namespace gnomon
