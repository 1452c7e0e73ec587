#include "renderer/prepare/box_depths.h"

#include <algorithm>
#include <cmath>

#include "renderer/core/block_strips.h"
#include "renderer/core/camera_view.h"
#include "renderer/prepare/footprint.h"
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
/// d * low to d * high (perspective), or from d * forward + low to d * forward + high.
Depths depthsIn(const CameraView& view, const Aabb& box, const BlockStrip& column, const BlockStrip& row) {
  const glm::dvec3 low = column.low + row.low;
  const glm::dvec3 high = column.high + row.high;
  const double center = glm::dot(box.center(), view.forward);
  const double half = glm::dot(box.halfExtent(), glm::abs(view.forward));
  Depths depths{std::max(view.near, center - half), std::min(view.far, center + half)};
  for (int axis = 0; axis < 3; ++axis) {
    const double forward = view.forward[axis];
    if (view.perspective) {
      depths.require(forward + high[axis], box.min[axis]);
      depths.require(-(forward + low[axis]), -box.max[axis]);
    } else {
      depths.require(forward, box.min[axis] - high[axis]);
      depths.require(-forward, low[axis] - box.max[axis]);
    }
  }
  return depths;
}

void widen(DepthSpan& span, const CameraView& view, const Depths& depths) {
  const auto nearest = static_cast<float>(depths.least - depthSlack(view, depths.least));
  const auto farthest = static_cast<float>(depths.greatest + depthSlack(view, depths.greatest));
  span = span.empty() ? DepthSpan{nearest, farthest}
                      : DepthSpan{std::min(span.nearest, nearest), std::max(span.farthest, farthest)};
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

} // namespace gnomon
