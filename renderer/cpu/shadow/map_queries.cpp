#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE \
  "renderer/cpu/shadow/map_queries.cpp" // NOLINT: Highway's foreach_target.h includes this file again
#include "renderer/cpu/shadow/map_queries.h"

#include <algorithm>
#include <hwy/foreach_target.h>

#include "renderer/core/parallel.h"
#include "renderer/cpu/raster/raster.h"
#include "renderer/cpu/shadow/certainty-inl.h"
#include "renderer/cpu/shadow/map_footprints-inl.h"
#include "renderer/cpu/surface/receivers-inl.h"

HWY_BEFORE_NAMESPACE();
namespace gnomon::cpu::HWY_NAMESPACE {

/// Sixteen pixels, and how many of a row of theirs lie in the picture.
struct PixelBlock {
  Fragments fragments; ///< of their first samples, in the middle of all
  Mask whole;          ///< lanes whose samples show the same
  int x, y;            ///< its lower left pixel
  int columns, rows;
};

inline PixelBlock pixelBlock(const DepthBuffer& surfaces, int column, int row, const glm::vec2& middle) {
  PixelBlock block{};
  block.x = column * kBlockSide;
  block.y = row * kBlockSide;
  block.columns = std::min(kBlockSide, surfaces.width - block.x);
  block.rows = std::min(kBlockSide, surfaces.height - block.y);
  Fragments& fragments = block.fragments;
  fragments.triangle = load(&surfaces.triangles[surfaces.blockAt(column, row)]);
  fragments.x = Int(block.x) + (laneNumbers() & Int(kBlockSide - 1));
  fragments.y = Int(block.y) + shiftRight<2>(laneNumbers());
  fragments.place = {toFloat(fragments.x) + middle.x, toFloat(fragments.y) + middle.y};
  block.whole = (fragments.x < Int(surfaces.width)) & (fragments.y < Int(surfaces.height));
  fragments.shown = block.whole & (fragments.triangle != Int(static_cast<std::int32_t>(kNoNumber)));
  for (int sample = 1; sample < surfaces.samples; ++sample) {
    const Int other = load(&surfaces.triangles[surfaces.blockAt(column, row, sample)]);
    block.whole = block.whole & (other == fragments.triangle);
  }
  return block;
}

/// Within a pixel.
inline glm::vec2 middleOf(int samples) {
  glm::vec2 sum(0);
  for (const glm::ivec2& place : samplePlaces(samples)) sum += glm::vec2(place) / 256.0f;
  return sum / static_cast<float>(samples);
}

void footprintRow(const MapQuery& query, int row, MapFootprint* out) {
  const DebugLight debug{query.maps, query.scene.frame, query.light};
  const DepthBuffer& surfaces = query.surfaces;
  for (int column = 0; column < surfaces.blocksAcross(); ++column) {
    const PixelBlock block = pixelBlock(surfaces, column, row, middleOf(1));
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

void verdictRow(const MapQuery& query, std::span<const TileOutlines> outlines, int row, Verdict* out) {
  const DebugLight debug{query.maps, query.scene.frame, query.light};
  const DepthBuffer& surfaces = query.surfaces;
  const glm::vec2 middle = middleOf(surfaces.samples);
  for (int column = 0; column < surfaces.blocksAcross(); ++column) {
    PixelBlock block = pixelBlock(surfaces, column, row, middle);
    block.fragments.shown = block.fragments.shown & block.whole;
    Int known = verdictNumber(Verdict::lit);
    if (any(block.fragments.shown)) known = verdicts(debug, receiversOf(query.scene, block.fragments), outlines);
    alignas(64) std::int32_t lanes[kLanes];
    store(select(block.whole, known, verdictNumber(Verdict::unsure)), lanes);
    for (int y = 0; y < block.rows; ++y) {
      Verdict* to = out + static_cast<std::ptrdiff_t>(block.y + y) * surfaces.width + block.x;
      for (int x = 0; x < block.columns; ++x) to[x] = static_cast<Verdict>(lanes[y * kBlockSide + x]);
    }
  }
}

} // namespace gnomon::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace gnomon::cpu {
namespace {

GNOMON_EXPORT_KERNEL(footprintRow);
GNOMON_EXPORT_KERNEL(verdictRow);

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

std::vector<Verdict> mapVerdicts(const MapQuery& query, std::span<const TileOutlines> outlines) {
  std::vector<Verdict> verdicts(pixelsOf(query.surfaces));
  forEach(static_cast<std::size_t>(query.surfaces.blocksUp()), [&](std::size_t row) {
    GNOMON_KERNEL(verdictRow)(query, outlines, static_cast<int>(row), verdicts.data());
  });
  return verdicts;
}

} // namespace gnomon::cpu
#endif
