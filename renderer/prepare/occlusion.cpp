#include "renderer/prepare/occlusion.h"

#include "renderer/prepare/footprint.h"

namespace gnomon {
namespace {

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
