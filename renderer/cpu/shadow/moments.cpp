#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE \
  "renderer/cpu/shadow/moments.cpp" // NOLINT: Highway's foreach_target.h includes this file again
#include "renderer/cpu/shadow/moments.h"

#include <algorithm>
#include <cmath>
#include <hwy/foreach_target.h>

#include "renderer/core/parallel.h"
#include "renderer/cpu/shadow/moment_rows.h"
#include "renderer/cpu/shadow/moments-inl.h"
#include "renderer/device/shader_data.h"

HWY_BEFORE_NAMESPACE();
namespace gnomon::cpu::HWY_NAMESPACE {

HWY_INLINE Float linearDepth(const MomentBlur& blur, const Float& z) {
  if (blur.farthest <= 0.0f) return z;
  const float span = blur.farthest - blur.nearest;
  const Float distance = blur.nearest * blur.farthest / (blur.farthest - z * span);
  return clamp((distance - blur.nearest) / span, 0.0f, 1.0f);
}

/// A row of one sample's depths, from the blocks that they lie in.
inline void copyRow(const DepthBuffer& depths, int y, int sample, float* row) {
  const int within = y % kBlockSide * kBlockSide;
  for (int column = 0; column < depths.blocksAcross(); ++column) {
    const float* from = depths.depths.data() + depths.blockAt(column, y / kBlockSide, sample) + within;
    std::copy_n(from, kBlockSide, row + column * kBlockSide);
  }
}

/// The moments of a row of texels, and those of its ends as far as the box reaches beyond them.
inline void sourceRow(const DepthBuffer& depths, const MomentBlur& blur, const BoxTaps& taps, int y, MomentRow& row) {
  for (int sample = 0; sample < depths.samples; ++sample) {
    copyRow(depths, y, sample, row.depths.data());
    for (std::size_t x = 0; x < row.width; x += kLanes) {
      const Moments of = momentsOf(linearDepth(blur, load(row.depths.data() + x)), blur.kind);
      const Float* const parts[] = {&of.x, &of.y, &of.z, &of.w};
      for (std::size_t m = 0; m < row.moments.size(); ++m) {
        float* at = row.moments[m].data() + taps.reach() + x;
        const Float before = sample == 0 ? Float(0.0f) : load(at);
        store(before + *parts[m] * (1.0f / static_cast<float>(depths.samples)), at);
      }
    }
  }
  const auto width = static_cast<std::size_t>(depths.width);
  for (std::vector<float>& moment : row.moments) {
    const auto first = moment.begin() + static_cast<std::ptrdiff_t>(taps.reach());
    const auto end = first + static_cast<std::ptrdiff_t>(width);
    std::fill(moment.begin(), first, *first);
    std::fill(end, moment.end(), end[-1]);
  }
}

void blurAlongRows(const DepthBuffer& depths, const MomentBlur& blur, const BoxTaps& taps, int firstRow, int lastRow,
                   MomentPlanes& out) {
  MomentRow row(out.width, taps.reach(), out.planes.size());
  for (int y = firstRow; y < lastRow; ++y) {
    sourceRow(depths, blur, taps, y, row);
    for (std::size_t m = 0; m < out.planes.size(); ++m) {
      for (std::size_t x = 0; x < out.width; x += kLanes) {
        Float sum = 0.0f;
        for (std::size_t i = 0; i < taps.weights.size(); ++i) {
          sum = mulAdd(load(row.moments[m].data() + x + i * taps.stride), taps.weights[i], sum);
        }
        store(sum / taps.sum, out.row(m, y) + x);
      }
    }
  }
}

HWY_INLINE Float blurredUp(const MomentPlanes& rows, const BoxTaps& taps, std::size_t moment, int y, std::size_t x) {
  if (moment >= rows.planes.size()) return 0.0f;
  Float sum = 0.0f;
  int at = y - static_cast<int>(taps.reach());
  for (const float weight : taps.weights) {
    sum = mulAdd(load(rows.row(moment, std::clamp(at, 0, rows.height - 1)) + x), weight, sum);
    at += static_cast<int>(taps.stride);
  }
  return sum / taps.sum;
}

void blurUp(const MomentPlanes& rows, const BoxTaps& taps, int width, int firstRow, int lastRow, glm::vec4* out) {
  alignas(64) float together[4 * kLanes];
  for (int y = firstRow; y < lastRow; ++y) {
    glm::vec4* to = out + static_cast<std::size_t>(y) * static_cast<std::size_t>(width);
    for (std::size_t x = 0; x < static_cast<std::size_t>(width); x += kLanes) {
      Float moments[4];
      for (std::size_t m = 0; m < 4; ++m) moments[m] = blurredUp(rows, taps, m, y, x);
      for (std::size_t i = 0; i < kParts; ++i) {
        hn::StoreInterleaved4(moments[0].part[i], moments[1].part[i], moments[2].part[i], moments[3].part[i], kFloats,
                              together + 4 * i * kPerPart);
      }
      const std::size_t count = std::min(kLanes, static_cast<std::size_t>(width) - x);
      std::copy_n(together, 4 * count, &to[x].x);
    }
  }
}

} // namespace gnomon::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace gnomon::cpu {
namespace {

HWY_EXPORT(blurAlongRows);
HWY_EXPORT(blurUp);

constexpr std::size_t kRowsAPiece = 16;

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

std::vector<glm::vec4> blurredMoments(const DepthBuffer& depths, const MomentBlur& blur) {
  const BoxTaps alongX = boxTaps(blur.reach.x);
  const BoxTaps alongY = boxTaps(blur.reach.y);
  MomentPlanes rows(depths.width, depths.height, blur.kind == GNOMON_FILTER_VSM ? 2 : 4);
  const auto count = static_cast<std::size_t>(depths.height);
  forEachPiece(count, kRowsAPiece, [&](std::size_t first, std::size_t last) {
    HWY_DYNAMIC_DISPATCH(blurAlongRows)
    (depths, blur, alongX, static_cast<int>(first), static_cast<int>(last), rows);
  });
  std::vector<glm::vec4> blurred(count * static_cast<std::size_t>(depths.width));
  forEachPiece(count, kRowsAPiece, [&](std::size_t first, std::size_t last) {
    HWY_DYNAMIC_DISPATCH(blurUp)
    (rows, alongY, depths.width, static_cast<int>(first), static_cast<int>(last), blurred.data());
  });
  return blurred;
}

} // namespace gnomon::cpu
#endif
