#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE \
  "renderer/cpu/raster/raster.cpp" // NOLINT: Highway's foreach_target.h includes this file again
#include "renderer/cpu/raster/raster.h"

#include <algorithm>
#include <cmath>
#include <hwy/foreach_target.h>

#include "renderer/core/parallel.h"
#include "renderer/cpu/raster/raster_corners-inl.h"
#include "renderer/cpu/raster/raster_square-inl.h"

HWY_BEFORE_NAMESPACE();
namespace gnomon::cpu::HWY_NAMESPACE {

/// The triangles of a draw that may cover a sample.
HWY_INLINE void sieve(const RasterInput& input, const RasterView& view, const RasterDraw& draw, PlacedCorners& corners,
                      std::vector<RasterTriangle>& kept) {
  const Slot& slot = input.slots[draw.slot];
  const glm::mat4& clip = input.clipFromLocal[slot.instance];
  const glm::vec3* vertices = input.scene.positions.data() + slot.baseVertex;
  const std::uint32_t* indices = input.scene.welded.data() + slot.firstIndex;
  const std::size_t indexCount = 3 * std::size_t{slot.triangles};
  const VertexRun run = vertexRun(indices, indexCount);
  const bool runs = run.count <= kWidestRun;
  if (runs) {
    corners.sources.clear();
    corners.first = run.first;
    placeCorners(view, clip, vertices + run.first, run.count, corners);
  } else {
    corners.sources.assign(indices, indices + indexCount);
    placeCorners(view, clip, vertices, indexCount, corners);
  }
  const auto clipOf = [&](std::uint32_t corner) {
    return glm::dmat4(clip) * glm::dvec4(vertices[corners.sourceOf(corner)], 1.0);
  };
  TriangleSieve(view, draw, kept).run(corners, runs ? indices : nullptr, slot.triangles, run.first, clipOf);
}

void sieveGroup(const RasterInput& input, const RasterView& view, std::span<const RasterDraw> draws,
                RasterScratch::Group& group) {
  group.triangles.clear();
  PlacedCorners corners;
  for (const RasterDraw& draw : draws) sieve(input, view, draw, corners, group.triangles);
}

template <DepthRange range, int samples>
HWY_INLINE void rasterEntries(const RasterView& view, const RasterScratch& scratch, int square, const Holes* holes,
                              DepthBuffer& target) {
  const std::uint64_t wanted = view.wanted(static_cast<std::size_t>(square));
  for (const RasterScratch::Group& group : scratch.groups) {
    const auto first = group.firstEntry[static_cast<std::size_t>(square)];
    const auto last = group.firstEntry[static_cast<std::size_t>(square) + 1];
    for (std::uint32_t i = first; i < last; ++i) {
      const RasterTriangle& triangle = group.triangles[group.entries[i]];
      const SquareSpan span = spanIn(view, triangle, square % view.squaresAcross, square / view.squaresAcross);
      if ((span.marks() & wanted) != 0) rasterTriangle<range, samples>(triangle, span, wanted, target, holes);
    }
  }
}

void rasterSquare(const RasterView& view, const RasterScratch& scratch, int square, const Holes* holes,
                  DepthBuffer& target) {
  const auto rasterAt = [&]<DepthRange range>() HWY_ATTR {
    view.samples == 1 ? rasterEntries<range, 1>(view, scratch, square, holes, target)
                      : rasterEntries<range, 4>(view, scratch, square, holes, target);
  };
  view.range == DepthRange::reversed ? rasterAt.template operator()<DepthRange::reversed>()
                                     : rasterAt.template operator()<DepthRange::clamped>();
}

} // namespace gnomon::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace gnomon::cpu {
namespace {

HWY_EXPORT(sieveGroup);
HWY_EXPORT(rasterSquare);

constexpr std::array<glm::ivec2, 1> kCentre{glm::ivec2(128, 128)};
constexpr std::array<glm::ivec2, 4> kStandardPattern{glm::ivec2(96, 32), glm::ivec2(224, 96), glm::ivec2(32, 160),
                                                     glm::ivec2(160, 224)};

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

/// False only where the triangle surely has no sample in a square whose corners, in 1/256 of a pixel, are these.
bool mayTouch(const RasterTriangle& triangle, const glm::i64vec2& least, const glm::i64vec2& most) {
  for (std::size_t i = 0; i < 3; ++i) {
    const Corner& from = triangle.corners[i];
    const Corner& to = triangle.corners[(i + 1) % 3];
    const std::int64_t a = std::int64_t{from.y} - to.y;
    const std::int64_t b = std::int64_t{to.x} - from.x;
    if (a * ((a > 0 ? most.x : least.x) - from.x) + b * ((b > 0 ? most.y : least.y) - from.y) < 0) return false;
  }
  return true;
}

/// Calls `each(square)` for the squares that a triangle may touch.
template <class Each>
void forEachSquare(const RasterView& view, const RasterTriangle& triangle, const Each& each) {
  const auto& c = triangle.corners;
  const PixelSpan across = pixelsWithin(std::min({c[0].x, c[1].x, c[2].x}), std::max({c[0].x, c[1].x, c[2].x}),
                                        view.firstSample.x, view.lastSample.x, view.width);
  const PixelSpan up = pixelsWithin(std::min({c[0].y, c[1].y, c[2].y}), std::max({c[0].y, c[1].y, c[2].y}),
                                    view.firstSample.y, view.lastSample.y, view.height);
  if (across.last < across.first || up.last < up.first) return;
  const int x0 = across.first / kSquareSide, x1 = across.last / kSquareSide;
  const int y0 = up.first / kSquareSide, y1 = up.last / kSquareSide;
  const bool few = (x1 - x0 + 1) * (y1 - y0 + 1) <= 2;
  const auto isWanted = [&](int x, int y, std::size_t square) {
    if (view.only == nullptr) return true;
    const auto block = [](int pixel, int of) {
      return std::clamp(pixel - of * kSquareSide, 0, kSquareSide - 1) / kMarkSide;
    };
    return (view.only->in(square)&blockBits(block(across.first, x), block(across.last, x), block(up.first, y),
                                            block(up.last, y))) != 0;
  };
  constexpr std::int64_t kSide = std::int64_t{kSquareSide} * kSubpixels;
  for (int y = y0; y <= y1; ++y) {
    for (int x = x0; x <= x1; ++x) {
      const auto square = static_cast<std::uint32_t>(y * view.squaresAcross + x);
      if (!isWanted(x, y, square)) continue;
      const glm::i64vec2 least(x * kSide, y * kSide);
      if (few || mayTouch(triangle, least, least + kSide)) each(square);
    }
  }
}

/// Of a square, those that are wanted.
void emptyBlocks(const RasterView& view, std::size_t square, DepthBuffer& target) {
  const auto across = static_cast<std::size_t>(view.squaresAcross);
  constexpr int kBlocks = kSquareSide / kBlockSide;
  const int firstColumn = static_cast<int>(square % across) * kBlocks,
            firstRow = static_cast<int>(square / across) * kBlocks;
  const std::uint64_t wanted = view.wanted(square);
  const float empty = view.range == DepthRange::reversed ? 0.0f : 1.0f;
  for (int row = 0; row < std::min(kBlocks, target.blocksUp() - firstRow); ++row) {
    for (int column = 0; column < std::min(kBlocks, target.blocksAcross() - firstColumn); ++column) {
      if ((wanted >> (8 * (row / 2) + column / 2) & 1u) == 0) continue;
      std::fill_n(
          target.depths.begin() + static_cast<std::ptrdiff_t>(target.blockAt(firstColumn + column, firstRow + row)),
          static_cast<std::size_t>(target.samples) * kBlockPlaces, empty);
    }
  }
}

/// Sorts a group's triangles by the squares that they may touch.
void sortIntoSquares(const RasterView& view, RasterScratch::Group& group) {
  struct Touch {
    std::uint32_t square, triangle;
  };
  std::vector<Touch> touches;
  touches.reserve(group.triangles.size() + group.triangles.size() / 4);
  const auto squares = static_cast<std::size_t>(view.squaresAcross) * static_cast<std::size_t>(view.squaresUp);
  group.firstEntry.assign(squares + 1, 0);
  for (std::uint32_t i = 0; i < group.triangles.size(); ++i) {
    forEachSquare(view, group.triangles[i], [&](std::uint32_t square) {
      touches.push_back({square, i});
      ++group.firstEntry[square];
    });
  }
  std::uint32_t end = 0;
  for (std::uint32_t& entry : group.firstEntry) entry = end += entry;
  group.entries.resize(touches.size());
  for (std::size_t i = touches.size(); i-- > 0;) {
    group.entries[--group.firstEntry[touches[i].square]] = touches[i].triangle;
  }
}

} // namespace

std::span<const glm::ivec2> samplePlaces(int samples) {
  return samples == 1 ? std::span<const glm::ivec2>(kCentre) : std::span<const glm::ivec2>(kStandardPattern);
}

DepthBuffer unfilledBuffer(int width, int height, int samples, DepthBuffer storage) {
  DepthBuffer buffer{width, height, samples, std::move(storage.depths), {}};
  // What was there need not be copied.
  buffer.depths.clear();
  if (buffer.depths.capacity() < buffer.places()) buffer.depths = {};
  buffer.depths.resize(buffer.places());
  return buffer;
}

DepthBuffer emptyBuffer(int width, int height, int samples, DepthRange range, bool numbered, DepthBuffer storage) {
  DepthBuffer buffer{width, height, samples, std::move(storage.depths), std::move(storage.triangles)};
  const std::size_t count = buffer.blocks() * static_cast<std::size_t>(samples) * kBlockPlaces;
  buffer.depths.resize(count);
  buffer.triangles.resize(numbered ? count : 0);
  constexpr std::size_t kPiece = 1u << 16;
  forEachPiece(count, kPiece, [&](std::size_t first, std::size_t last) {
    std::fill(&buffer.depths[first], buffer.depths.data() + last, range == DepthRange::reversed ? 0.0f : 1.0f);
    if (numbered) std::fill(&buffer.triangles[first], buffer.triangles.data() + last, kNoNumber);
  });
  return buffer;
}

std::uint64_t raster(const RasterInput& input, DepthRange range, DepthBuffer& target, RasterScratch& scratch) {
  const RasterView view = viewOf(target, range, input.only);
  const std::vector<std::size_t> starts = groupsOf(input);
  scratch.groups.resize(starts.size() - 1);
  forEach(scratch.groups.size(), [&](std::size_t i) {
    HWY_DYNAMIC_DISPATCH(sieveGroup)
    (input, view, input.draws.subspan(starts[i], starts[i + 1] - starts[i]), scratch.groups[i]);
    sortIntoSquares(view, scratch.groups[i]);
  });
  forEach(static_cast<std::size_t>(view.squaresAcross) * static_cast<std::size_t>(view.squaresUp), [&](std::size_t i) {
    if (view.wanted(i) == 0) return;
    if (input.only != nullptr) emptyBlocks(view, i, target);
    HWY_DYNAMIC_DISPATCH(rasterSquare)(view, scratch, static_cast<int>(i), input.holes, target);
  });
  std::uint64_t triangles = 0;
  for (const RasterDraw& draw : input.draws) triangles += input.slots[draw.slot].triangles;
  return triangles;
}

} // namespace gnomon::cpu
#endif
