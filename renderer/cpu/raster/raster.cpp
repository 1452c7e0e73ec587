#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE \
  "renderer/cpu/raster/raster.cpp" // NOLINT: Highway's foreach_target.h includes this file again
#include "renderer/cpu/raster/raster.h"

#include <algorithm>
#include <cmath>
#include <hwy/foreach_target.h>

#include "renderer/core/parallel.h"
#include "renderer/cpu/raster/raster_sieve-inl.h"
#include "renderer/cpu/raster/raster_wide_square-inl.h"

HWY_BEFORE_NAMESPACE();
namespace gnomon::cpu::HWY_NAMESPACE {

/// The triangles of a draw that may cover a wanted sample.
HWY_INLINE void sieve(const RasterInput& input, const RasterView& view, const RasterDraw& draw, PlacedCorners& corners,
                      TriangleGroup& group) {
  const Slot& slot = input.slots[draw.slot];
  const glm::mat4& clip = input.clipFromLocal[slot.instance];
  const std::span<const glm::vec3> vertices = std::span(input.scene.positions).subspan(slot.baseVertex);
  const std::uint32_t* indices = input.scene.welded.data() + slot.firstIndex;
  const std::size_t indexCount = 3 * std::size_t{slot.triangles};
  const VertexRun run = vertexRun(indices, indexCount);
  const bool runs = run.count <= kWidestRun;
  corners.sources.clear();
  corners.first = runs ? run.first : 0;
  if (!runs) corners.sources.assign(indices, indices + indexCount);
  placeCorners(view, clip, vertices, runs ? run.count : indexCount, corners);
  const auto clipOf = [&](std::uint32_t corner) {
    return glm::dmat4(clip) * glm::dvec4(vertices[corners.sourceOf(corner)], 1.0);
  };
  TriangleSieve(view, draw, group).run(corners, runs ? indices : nullptr, slot.triangles, clipOf);
}

void sieveGroup(const RasterInput& input, const RasterView& view, std::span<const RasterDraw> draws,
                TriangleGroup& group) {
  group.small.clear(view.samples);
  group.wide.clear();
  group.touches.clear();
  PlacedCorners corners;
  for (const RasterDraw& draw : draws) sieve(input, view, draw, corners, group);
}

template <DepthRange range, int samples>
HWY_INLINE void rasterEntries(const RasterInput& input, std::span<const TriangleGroup> groups, std::size_t index,
                              const Square& square) {
  HoledPixels<range, samples> holed(input, square.depths, square.numbers);
  for (const TriangleGroup& group : groups) {
    const std::uint32_t* const end = group.entries.data() + group.firstEntry[index + 1];
    for (const std::uint32_t* at = group.entries.data() + group.firstEntry[index]; at != end; ++at) {
      const std::uint32_t entry = *at;
      if ((entry & kWideEntry) == 0) {
        rasterSmall<range, samples>(group.small.at(entry), square, holed);
      } else {
        rasterWide<range, samples>(group.wide[entry & ~kWideEntry], square, holed);
      }
    }
  }
  holed.settle();
}

void rasterSquare(const RasterInput& input, const RasterView& view, std::span<const TriangleGroup> groups,
                  std::size_t index, DepthBuffer& target) {
  constexpr int kBlocks = kSquareSide / kBlockSide;
  const auto across = static_cast<std::size_t>(view.squaresAcross);
  const int column = static_cast<int>(index % across) * kBlocks, row = static_cast<int>(index / across) * kBlocks;
  const BlockSpan blocks{column, row, std::min(column + kBlocks, target.blocksAcross()) - 1,
                         std::min(row + kBlocks, target.blocksUp()) - 1};
  const Square square{target.depths.data(), target.triangles.empty() ? nullptr : target.triangles.data(),
                      target.blocksAcross(), blocks, view.wanted(index)};
  const auto rasterAt = [&]<DepthRange range>() HWY_ATTR {
    view.samples == 1 ? rasterEntries<range, 1>(input, groups, index, square)
                      : rasterEntries<range, 4>(input, groups, index, square);
  };
  view.range == DepthRange::reversed ? rasterAt.template operator()<DepthRange::reversed>()
                                     : rasterAt.template operator()<DepthRange::clamped>();
}

} // namespace gnomon::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace gnomon::cpu {
namespace {

GNOMON_EXPORT_KERNEL(sieveGroup);
GNOMON_EXPORT_KERNEL(rasterSquare);

RasterView viewOf(const DepthBuffer& target, DepthRange range, const TexelMarks* only) {
  RasterView view;
  view.only = only;
  view.width = target.width;
  view.height = target.height;
  view.samples = target.samples;
  view.range = range;
  const std::span<const glm::ivec2> places = samplePlaces(target.samples);
  view.firstSample = view.lastSample = places.front();
  for (const glm::ivec2& place : places) {
    view.firstSample = glm::min(view.firstSample, place);
    view.lastSample = glm::max(view.lastSample, place);
  }
  view.squaresAcross = (target.width + kSquareSide - 1) / kSquareSide;
  view.squaresUp = (target.height + kSquareSide - 1) / kSquareSide;
  return view;
}

/// Triangles that a group has at least, but for the last one.
constexpr std::uint32_t kGroupTriangles = 4 * kClusterTriangles;

/// Where groups of draws begin, and the end.
std::vector<std::size_t> groupsOf(const RasterInput& input) {
  std::vector<std::size_t> starts{0};
  std::uint32_t triangles = 0;
  for (std::size_t i = 0; i < input.draws.size(); ++i) {
    triangles += input.slots[input.draws[i].slot].triangles;
    if (triangles < kGroupTriangles) continue;
    starts.push_back(i + 1);
    triangles = 0;
  }
  if (starts.back() != input.draws.size()) starts.push_back(input.draws.size());
  return starts;
}

/// Of a square, what is wanted.
void emptyBlocks(const RasterView& view, std::size_t square, DepthBuffer& target) {
  const auto across = static_cast<std::size_t>(view.squaresAcross);
  constexpr int kBlocks = kSquareSide / kBlockSide;
  const int firstColumn = static_cast<int>(square % across) * kBlocks,
            firstRow = static_cast<int>(square / across) * kBlocks;
  const int columns = std::min(kBlocks, target.blocksAcross() - firstColumn);
  const std::uint64_t wanted = view.wanted(square);
  const float empty = view.range == DepthRange::reversed ? 0.0f : 1.0f;
  const auto fill = [&](int row, int column, int count) {
    const std::size_t at = target.blockAt(firstColumn + column, firstRow + row);
    const auto values = static_cast<std::size_t>(count * target.samples * kBlockPlaces);
    std::fill_n(target.depths.data() + at, values, empty);
    if (!target.triangles.empty()) std::fill_n(target.triangles.data() + at, values, kNoNumber);
  };
  for (int row = 0; row < std::min(kBlocks, target.blocksUp() - firstRow); ++row) {
    const auto here = static_cast<unsigned>(wanted >> (8 * (row / 2)) & 0xffu);
    if (here == 0xffu) {
      fill(row, 0, columns);
      continue;
    }
    for (int column = 0; column < columns; column += 2) {
      if ((here >> (column / 2) & 1u) != 0) fill(row, column, std::min(2, columns - column));
    }
  }
}

/// Sorts a group's triangles by the squares that they may touch.
void sortIntoSquares(const RasterView& view, TriangleGroup& group) {
  group.firstEntry.assign(view.squares() + 1, 0);
  std::uint32_t* const first = group.firstEntry.data();
  for (const SquareTouch& touch : group.touches) ++first[touch.square];
  std::uint32_t end = 0;
  for (std::uint32_t& entry : group.firstEntry) entry = end += entry;
  group.entries.resize(group.touches.size());
  std::uint32_t* const entries = group.entries.data();
  for (const SquareTouch* touch = group.touches.end(); touch != group.touches.begin();) {
    --touch;
    entries[--first[touch->square]] = touch->entry;
  }
}

} // namespace

std::span<const glm::ivec2> samplePlaces(int samples) {
  return samples == 1 ? std::span<const glm::ivec2>(kSamplePlaces<1>) : std::span<const glm::ivec2>(kSamplePlaces<4>);
}

DepthBuffer unfilledBuffer(int width, int height, int samples, bool numbered, DepthBuffer storage) {
  DepthBuffer buffer{width, height, samples, std::move(storage.depths), std::move(storage.triangles)};
  const auto fit = [](auto& values, std::size_t count) {
    // What was there need not be copied.
    values.clear();
    if (values.capacity() < count) values = {};
    values.resize(count);
  };
  fit(buffer.depths, buffer.places());
  fit(buffer.triangles, numbered ? buffer.places() : 0);
  return buffer;
}

std::uint64_t raster(const RasterInput& input, DepthRange range, DepthBuffer& target, RasterScratch& scratch) {
  const RasterView view = viewOf(target, range, input.only);
  const std::vector<std::size_t> starts = groupsOf(input);
  if (scratch.groups.size() < starts.size() - 1) scratch.groups.resize(starts.size() - 1);
  const std::span<TriangleGroup> groups = std::span(scratch.groups).first(starts.size() - 1);
  forEach(groups.size(), [&](std::size_t i) {
    GNOMON_KERNEL(sieveGroup)
    (input, view, input.draws.subspan(starts[i], starts[i + 1] - starts[i]), groups[i]);
    sortIntoSquares(view, groups[i]);
  });
  forEach(view.squares(), [&](std::size_t i) {
    if (view.wanted(i) == 0) return;
    if (input.fresh || input.only != nullptr) emptyBlocks(view, i, target);
    GNOMON_KERNEL(rasterSquare)(input, view, groups, i, target);
  });
  std::uint64_t triangles = 0;
  for (const RasterDraw& draw : input.draws) triangles += input.slots[draw.slot].triangles;
  return triangles;
}

} // namespace gnomon::cpu
#endif
