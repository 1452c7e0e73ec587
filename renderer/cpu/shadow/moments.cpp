#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE \
  "renderer/cpu/shadow/moments.cpp" // NOLINT: Highway's foreach_target.h includes this file again
#include "renderer/cpu/shadow/moments.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <hwy/foreach_target.h>

#include "renderer/core/parallel.h"
#include "renderer/cpu/lanes/shared_functions-inl.h"
#include "renderer/cpu/shadow/moment_rows.h"
#include "renderer/device/shader_data.h"

HWY_BEFORE_NAMESPACE();
namespace gnomon::cpu::HWY_NAMESPACE {

/// A row of one sample's depths, from the blocks that they lie in; beyond the tile its outermost ones.
inline void copyRow(const DepthBuffer& depths, int firstX, int y, int sample, std::vector<float>& row) {
  const float* from = depths.depths.data() + depths.blockAt(0, y / kBlockSide, sample) + y % kBlockSide * kBlockSide;
  const std::ptrdiff_t block = std::ptrdiff_t{depths.samples} * kBlockPlaces;
  const int count = static_cast<int>(row.size());
  for (int i = 0; i < count; ++i) {
    const int x = std::clamp(firstX + i, 0, depths.width - 1);
    row.data()[i] = from[x / kBlockSide * block + x % kBlockSide];
  }
}

/// The moments of a row of texels, the first of them at `firstX`.
inline void sourceRow(const DepthBuffer& depths, const MomentBlur& blur, int firstX, int y, MomentWindow& window) {
  for (int sample = 0; sample < depths.samples; ++sample) {
    copyRow(depths, firstX, y, sample, window.depths);
    for (std::size_t x = 0; x < window.sourceWidth; x += kLanes) {
      const Float4 of = momentsOf(linearDepth(blur.nearest, blur.farthest, load(window.depths.data() + x)), blur.kind);
      const Float* const parts[] = {&of.x, &of.y, &of.z, &of.w};
      for (std::size_t m = 0; m < window.row.size(); ++m) {
        float* at = window.row[m].data() + x;
        const Float before = sample == 0 ? Float(0.0f) : load(at);
        store(before + *parts[m] * (1.0f / static_cast<float>(depths.samples)), at);
      }
    }
  }
}

/// The mean of values `step` apart.
HWY_INLINE Float blurredAt(const float* first, const BoxTaps& taps, std::size_t step) {
  Float sum = 0.0f;
  for (std::size_t k = 0; k < taps.weights.size(); ++k) {
    sum = mulAdd(load(first + k * step), taps.weights.data()[k], sum);
  }
  return sum / taps.sum;
}

/// The rows of the box and beyond, blurred along x; beyond the tile its outermost ones.
inline void blurAlongRows(const DepthBuffer& depths, const MomentBlur& blur, const MomentTaps& taps,
                          const TexelBox& box, MomentWindow& window) {
  const int firstX = box.x0 - static_cast<int>(taps.x.reach());
  const int firstY = box.y0 - static_cast<int>(taps.y.reach());
  int last = -1;
  for (std::size_t i = 0; i < window.rows; ++i) {
    const int y = std::clamp(firstY + static_cast<int>(i), 0, depths.height - 1);
    if (y != last) sourceRow(depths, blur, firstX, y, window);
    for (std::size_t m = 0; m < window.row.size(); ++m) {
      float* const out = window.alongRow(m, i);
      if (y == last) {
        std::copy_n(window.alongRow(m, i - 1), window.width, out);
        continue;
      }
      for (std::size_t x = 0; x < window.width; x += kLanes) {
        store(blurredAt(window.row[m].data() + x, taps.x, taps.x.stride), out + x);
      }
    }
    last = y;
  }
}

/// `out`: all moments of the tile.
void blurBox(const DepthBuffer& depths, const MomentBlur& blur, const MomentTaps& taps, const TexelBox& box,
             glm::vec4* out) {
  MomentWindow window(box, taps.x, taps.y, blur.kind == GNOMON_FILTER_VSM ? 2 : 4);
  blurAlongRows(depths, blur, taps, box, window);
  alignas(64) float together[4 * kLanes];
  for (int y = 0; y < box.height; ++y) {
    glm::vec4* to = out + static_cast<std::ptrdiff_t>(box.y0 + y) * depths.width + box.x0;
    for (std::size_t x = 0; x < static_cast<std::size_t>(box.width); x += kLanes) {
      Float moments[4];
      for (std::size_t m = 0; m < 4; ++m) {
        moments[m] = m < window.along.size() ? blurredAt(window.alongRow(m, static_cast<std::size_t>(y)) + x, taps.y,
                                                         taps.y.stride * window.width)
                                             : Float(0.0f);
      }
      for (std::size_t i = 0; i < kParts; ++i) {
        hn::StoreInterleaved4(moments[0].part[i], moments[1].part[i], moments[2].part[i], moments[3].part[i], kFloats,
                              together + 4 * i * kPerPart);
      }
      const std::size_t count = std::min(kLanes, static_cast<std::size_t>(box.width) - x);
      std::copy_n(together, 4 * count, &to[x].x);
    }
  }
}

} // namespace gnomon::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace gnomon::cpu {
namespace {

GNOMON_EXPORT_KERNEL(blurBox);

/// The texels around what is marked in a square.
TexelBox boxIn(const TexelMarks& marks, std::size_t square) {
  std::uint64_t columns = marks.in(square), rows = columns;
  for (const int step : {8, 16, 32}) columns |= columns >> step;
  columns &= 0xffu;
  for (const int step : {1, 2, 4}) rows |= rows >> step;
  rows &= 0x0101010101010101u;
  const int first = std::countr_zero(columns), end = 64 - std::countl_zero(columns);
  const int low = std::countr_zero(rows) / 8, high = (63 - std::countl_zero(rows)) / 8 + 1;
  const int across = (marks.width() + kMarkSquare - 1) / kMarkSquare;
  TexelBox box;
  box.x0 = static_cast<int>(square) % across * kMarkSquare + first * kMarkSide;
  box.y0 = static_cast<int>(square) / across * kMarkSquare + low * kMarkSide;
  box.width = std::min((end - first) * kMarkSide, marks.width() - box.x0);
  box.height = std::min((high - low) * kMarkSide, marks.height() - box.y0);
  return box;
}

MomentTaps tapsOf(const MomentBlur& blur) {
  return {boxTaps(blur.reach.x), boxTaps(blur.reach.y)};
}

} // namespace

MomentBlur momentBlur(const ShadowTile& tile) {
  MomentBlur blur;
  blur.kind = filterKind(tile.filter);
  const glm::dvec2 texels = tile.filter.radius > 0 ? tile.space.fit.radius / tile.space.fit.texelSize - 0.5
                                                   : glm::dvec2(0.5 * (tile.filter.size - 1));
  blur.reach = glm::vec2(glm::max(glm::dvec2(0.0), texels));
  if (tile.space.fit.perspective) {
    blur.nearest = static_cast<float>(tile.near);
    blur.farthest = static_cast<float>(tile.far);
  }
  return blur;
}

glm::ivec2 readAround(const MomentBlur& blur) {
  const MomentTaps taps = tapsOf(blur);
  return glm::ivec2(static_cast<int>(taps.x.reach()), static_cast<int>(taps.y.reach()));
}

void blurMoments(const DepthBuffer& depths, const MomentBlur& blur, const TexelMarks& wanted,
                 std::span<glm::vec4> moments) {
  const MomentTaps taps = tapsOf(blur);
  forEach(wanted.squares(), [&](std::size_t i) {
    if (wanted.in(i) == 0) return;
    GNOMON_KERNEL(blurBox)(depths, blur, taps, boxIn(wanted, i), moments.data());
  });
}

} // namespace gnomon::cpu
#endif
