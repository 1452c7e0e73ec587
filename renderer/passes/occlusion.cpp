#include "renderer/passes/occlusion.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace gnomon {
namespace {

/// A box on the picture: the blocks that it may touch, and its least view depth.
struct Footprint {
  int firstColumn = 0, lastColumn = -1;
  int firstRow = 0, lastRow = -1;
  double nearest = 0;
};

/// Absent for a box that reaches in front of the near plane: it may cover anything.
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

/// True where `shows` holds for any block of the footprint, told the block and the box's least depth.
template <class Shows>
bool anyBlock(const ReceiverDepths& depths, const Footprint& footprint, Shows shows) {
  // Surveyed depths are floats, linearized: they may lie a few roundings nearer than the surface.
  const double nearest = footprint.nearest * (1 - 1e-5) - 1e-30;
  for (int row = footprint.firstRow; row <= footprint.lastRow; ++row) {
    const DepthSpan* blocks = depths.blocks.data() + static_cast<std::size_t>(row) * depths.columns;
    for (int column = footprint.firstColumn; column <= footprint.lastColumn; ++column) {
      if (shows(blocks[column], nearest)) return true;
    }
  }
  return false;
}

template <class Shows>
std::vector<std::uint8_t> boxesThatShow(const CameraView& view, const ReceiverDepths& depths,
                                        std::span<const Aabb> boxes, std::span<const std::uint8_t> wanted,
                                        Shows shows) {
  std::vector<std::uint8_t> visible(boxes.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    if (wanted[i] == 0) continue;
    const auto footprint = footprintOf(view, depths, boxes[i]);
    visible[i] = static_cast<std::uint8_t>(!footprint || anyBlock(depths, *footprint, shows));
  }
  return visible;
}

} // namespace

std::vector<std::uint8_t> visibleBoxes(const CameraView& view, const ReceiverDepths& depths,
                                       std::span<const Aabb> boxes, std::span<const std::uint8_t> drawn) {
  return boxesThatShow(view, depths, boxes, drawn, [](const DepthSpan& block, double nearest) {
    return !block.empty() && block.farthest >= nearest;
  });
}

std::vector<std::uint8_t> unhiddenBoxes(const CameraView& view, const ReceiverDepths& depths,
                                        std::span<const Aabb> boxes, std::span<const std::uint8_t> wanted) {
  return boxesThatShow(view, depths, boxes, wanted,
                       [](const DepthSpan& block, double nearest) { return block.open || block.farthest >= nearest; });
}

} // namespace gnomon
