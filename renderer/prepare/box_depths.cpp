#include "renderer/prepare/box_depths.h"

#include <algorithm>
#include <cmath>

#include "renderer/core/camera_view.h"
#include "renderer/shadow/depth_range.h"

namespace gnomon {
namespace {

/// The depths d with least <= d and d <= greatest, made narrower by conditions of the form factor * d >= bound.
struct Depths {
  double least = 0;
  double greatest = 0;

  void require(double factor, double bound) {
    if (factor > 0) {
      least = std::max(least, bound / factor);
    } else if (factor < 0) {
      greatest = std::min(greatest, bound / factor);
    } else if (bound > 0) {
      greatest = -HUGE_VAL;
    }
  }
};

/// The depths at which a block's piece of the view may meet the box. Each coordinate by itself: at depth d it runs from
/// d * low to d * high (perspective), or from d * middle + low to d * middle + high.
Depths depthsIn(const CameraView& view, const Aabb& box, const BlockStrip& column, const BlockStrip& row) {
  const glm::dvec3 low = column.low + row.low;
  const glm::dvec3 high = column.high + row.high;
  const double center = glm::dot(box.center(), view.forward);
  const double half = glm::dot(box.halfExtent(), glm::abs(view.forward));
  Depths depths{std::max(view.near, center - half), std::min(view.far, center + half)};
  const glm::dvec3 middle = wayToMiddle(view);
  for (int axis = 0; axis < 3; ++axis) {
    if (view.perspective) {
      depths.require(middle[axis] + high[axis], box.min[axis]);
      depths.require(-(middle[axis] + low[axis]), -box.max[axis]);
    } else {
      depths.require(middle[axis], box.min[axis] - high[axis]);
      depths.require(-middle[axis], low[axis] - box.max[axis]);
    }
  }
  return depths;
}

/// A little wider than the picture, for what rasterizers round.
constexpr double kWider = 1.01;

void widen(DepthSpan& span, const CameraView& view, const Depths& depths) {
  const auto nearest = static_cast<float>(depths.least - depthSlack(view, depths.least));
  const auto farthest = static_cast<float>(depths.greatest + depthSlack(view, depths.greatest));
  span = span.empty() ? DepthSpan{nearest, farthest}
                      : DepthSpan{std::min(span.nearest, nearest), std::max(span.farthest, farthest)};
}

/// True where `shows` holds for any block of the footprint, given the block and the box's least depth.
template <class Shows>
bool anyBlock(const CameraView& view, const ReceiverDepths& depths, const Footprint& footprint, Shows shows) {
  // Surveyed depths are floats, linearized: they may lie a few roundings nearer than the surface.
  const double nearest = footprint.nearest - depthSlack(view, footprint.nearest) - 1e-30;
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
    visible[i] = static_cast<std::uint8_t>(!footprint || anyBlock(view, depths, *footprint, shows));
  }
  return visible;
}

} // namespace

ReceiverDepths emptyDepths(int width, int height) {
  ReceiverDepths grid;
  grid.width = width;
  grid.height = height;
  grid.columns = (width + grid.blockSize - 1) / grid.blockSize;
  grid.rows = (height + grid.blockSize - 1) / grid.blockSize;
  return grid;
}

ReceiverDepths boxDepths(const CameraView& view, int width, int height, std::span<const Aabb> boxes,
                         std::span<const std::uint8_t> drawn) {
  ReceiverDepths grid = emptyDepths(width, height);
  grid.blocks.resize(static_cast<std::size_t>(grid.columns) * static_cast<std::size_t>(grid.rows));
  const auto columns = blockStrips(grid.columns, grid.blockSize, width, view.right * view.halfSize.x);
  const auto rows = blockStrips(grid.rows, grid.blockSize, height, view.up * -view.halfSize.y); // from the top
  const Frustum frustum = frustumOf(view);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    if (drawn[i] == 0 || boxes[i].empty() || !mayIntersect(frustum, boxes[i])) continue;
    const Footprint all{0, grid.columns - 1, 0, grid.rows - 1, 0};
    const Footprint print = footprintOf(view, grid, boxes[i]).value_or(all);
    for (int row = print.firstRow; row <= print.lastRow; ++row) {
      for (int column = print.firstColumn; column <= print.lastColumn; ++column) {
        const Depths depths =
            depthsIn(view, boxes[i], columns[static_cast<std::size_t>(column)], rows[static_cast<std::size_t>(row)]);
        if (!(depths.least <= depths.greatest)) continue;
        widen(grid.blocks[static_cast<std::size_t>(row * grid.columns + column)], view, depths);
      }
    }
  }
  for (const DepthSpan& span : grid.blocks) {
    if (span.empty()) continue;
    grid.range = grid.range.empty() ? span
                                    : DepthSpan{std::min(grid.range.nearest, span.nearest),
                                                std::max(grid.range.farthest, span.farthest)};
  }
  return grid;
}

std::optional<DepthInterval> possibleDepths(const CameraView& view, const Aabb& box) {
  if (box.empty()) return std::nullopt;
  CameraView open = view;
  open.near = -HUGE_VAL;
  open.far = HUGE_VAL;
  const auto strip = [](const glm::dvec3& half) { return BlockStrip{-glm::abs(half), glm::abs(half)}; };
  const Depths depths =
      depthsIn(open, box, strip(view.right * (view.halfSize.x * kWider)), strip(view.up * (view.halfSize.y * kWider)));
  if (!(depths.least <= depths.greatest)) return std::nullopt;
  return DepthInterval{depths.least, depths.greatest};
}

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
    const glm::dvec2 ndc = ndcOf(view, p);
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
