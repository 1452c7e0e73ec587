#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE \
  "renderer/cpu/raster/depth_spans.cpp" // NOLINT: Highway's foreach_target.h includes this file again
#include "renderer/cpu/raster/depth_spans.h"

#include <algorithm>
#include <hwy/foreach_target.h>

#include "renderer/cpu/lanes/lanes-inl.h"
#include "renderer/prepare/draw_list.h"

HWY_BEFORE_NAMESPACE();
namespace gnomon::cpu::HWY_NAMESPACE {

/// Of the blocks from `firstColumn` to before `endColumn`.
HWY_INLINE DepthEnds endsOf(const DepthBuffer& buffer, int y0, int y1, int firstColumn, int endColumn) {
  const DepthEnds none;
  Float nearest(none.nearest), farthest(none.farthest), least(none.least);
  const Int x = laneNumbers() & Int(kBlockSide - 1), y = shiftRight<2>(laneNumbers());
  for (int row = y0 / kBlockSide; row <= y1 / kBlockSide; ++row) {
    const Mask inRows = (y >= Int(y0 - row * kBlockSide)) & (y <= Int(y1 - row * kBlockSide));
    for (int column = firstColumn; column < endColumn; ++column) {
      const Mask own = inRows & (x < Int(buffer.width - column * kBlockSide));
      const float* depths = buffer.depths.data() + buffer.blockAt(column, row);
      for (int s = 0; s < buffer.samples; ++s) {
        const Float depth = load(depths + s * kBlockPlaces);
        nearest = max(nearest, select(own, depth, none.nearest));
        least = min(least, select(own, depth, none.least));
        farthest = min(farthest, select(own & (depth > 0.0f), depth, none.farthest));
      }
    }
  }
  return {greatestLane(nearest), leastLane(farthest), leastLane(least)};
}

void depthEndsOn(const DepthBuffer& buffer, int y0, int y1, int side, std::vector<DepthEnds>& ends) {
  const int blocks = side / kBlockSide;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const int column = static_cast<int>(i) * blocks;
    ends[i] = endsOf(buffer, y0, y1, column, std::min(column + blocks, buffer.blocksAcross()));
  }
}

} // namespace gnomon::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace gnomon::cpu {
namespace {

GNOMON_EXPORT_KERNEL(depthEndsOn);

} // namespace

std::vector<DepthEnds> depthEnds(const DepthBuffer& buffer, int y0, int y1, int side) {
  std::vector<DepthEnds> ends(static_cast<std::size_t>((buffer.width + side - 1) / side));
  GNOMON_KERNEL(depthEndsOn)(buffer, y0, y1, side, ends);
  return ends;
}

std::vector<DepthEnds> depthEnds(const DepthBuffer& buffer, int y0, int y1, int side,
                                 std::span<const std::uint8_t> slots) {
  std::vector<DepthEnds> ends(static_cast<std::size_t>((buffer.width + side - 1) / side));
  for (int y = y0; y <= y1; ++y) {
    for (int x = 0; x < buffer.width; ++x) {
      DepthEnds& of = ends[static_cast<std::size_t>(x / side)];
      for (int s = 0; s < buffer.samples; ++s) {
        const std::size_t at = buffer.at(x, y, s);
        const std::uint32_t triangle = buffer.triangles[at];
        const bool counts = triangle != kNoNumber && slots[triangle / kClusterTriangles] != 0;
        const float depth = counts ? buffer.depths[at] : 0.0f;
        of.nearest = std::max(of.nearest, depth);
        of.least = std::min(of.least, depth);
        if (depth > 0.0f) of.farthest = std::min(of.farthest, depth);
      }
    }
  }
  return ends;
}

} // namespace gnomon::cpu
#endif
