#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE \
  "renderer/cpu/shadow/map_queries.cpp" // NOLINT: Highway's foreach_target.h includes this file again
#include "renderer/cpu/shadow/map_queries.h"

#include <algorithm>
#include <hwy/foreach_target.h>

#include "renderer/core/parallel.h"
#include "renderer/cpu/shadow/map_footprints-inl.h"
#include "renderer/cpu/surface/receivers-inl.h"
#include "renderer/prepare/draw_list.h"

HWY_BEFORE_NAMESPACE();
namespace gnomon::cpu::HWY_NAMESPACE {

/// Sixteen pixels of one sample, and how many of a row of theirs lie in the picture.
struct PixelBlock {
  Fragments fragments;
  int x, y; ///< its lower left pixel
  int columns, rows;
};

inline PixelBlock pixelBlock(const DepthBuffer& surfaces, int column, int row) {
  PixelBlock block{};
  block.x = column * kBlockSide;
  block.y = row * kBlockSide;
  block.columns = std::min(kBlockSide, surfaces.width - block.x);
  block.rows = std::min(kBlockSide, surfaces.height - block.y);
  Fragments& fragments = block.fragments;
  fragments.triangle = load(&surfaces.triangles[surfaces.blockAt(column, row)]);
  fragments.x = Int(block.x) + (laneNumbers() & Int(kBlockSide - 1));
  fragments.y = Int(block.y) + shiftRight<2>(laneNumbers());
  fragments.place = {toFloat(fragments.x) + 0.5f, toFloat(fragments.y) + 0.5f};
  fragments.shown = (fragments.x < Int(surfaces.width)) & (fragments.y < Int(surfaces.height)) &
                    (fragments.triangle != Int(static_cast<std::int32_t>(kNoNumber)));
  return block;
}

void footprintRow(const MapQuery& query, int row, MapFootprint* out) {
  const DebugLight debug{query.maps, query.scene.frame, query.light};
  const DepthBuffer& surfaces = query.surfaces;
  for (int column = 0; column < surfaces.blocksAcross(); ++column) {
    const PixelBlock block = pixelBlock(surfaces, column, row);
    if (none(block.fragments.shown)) continue;
    const Receiver receiver = receiversOf(query.scene, block.fragments);
    MapFootprint footprints[kLanes];
    storeFootprints(footprintsOf(debug, receiver), receiver, kLanes, footprints);
    for (int y = 0; y < block.rows; ++y) {
      // First row on top.
      MapFootprint* to = out + static_cast<std::ptrdiff_t>(surfaces.height - 1 - block.y - y) * surfaces.width;
      std::copy_n(footprints + y * kBlockSide, block.columns, to + block.x);
    }
  }
}

} // namespace gnomon::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace gnomon::cpu {
namespace {

GNOMON_EXPORT_KERNEL(footprintRow);

std::size_t pixelsOf(const DepthBuffer& surfaces) {
  return static_cast<std::size_t>(surfaces.width) * static_cast<std::size_t>(surfaces.height);
}

} // namespace

std::vector<MapFootprint> mapFootprints(const MapQuery& query) {
  std::vector<MapFootprint> footprints(pixelsOf(query.surfaces));
  forEach(static_cast<std::size_t>(query.surfaces.blocksUp()), [&](std::size_t row) {
    GNOMON_KERNEL(footprintRow)(query, static_cast<int>(row), footprints.data());
  });
  return footprints;
}

} // namespace gnomon::cpu
#endif
