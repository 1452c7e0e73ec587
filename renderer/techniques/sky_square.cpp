#include "renderer/techniques/sky_square.h"

#include <algorithm>
#include <cstdlib>

#include "renderer/core/instruction_sets.h"

namespace gnomon {
namespace {

constexpr std::size_t kRow = SkySquare::kSide; ///< pixels

constexpr float kSkyFlat = 0.04f;       ///< squared sine of the steepest way from a pixel to one of the same surface
constexpr float kSkyLeastCosine = 0.9f; ///< of their normals
constexpr float kSkyFewest = 1e-3f;     ///< squared pixels; without a second direction there is no slope

/// How far around a pixel shares are asked for, and how many times noise's variance they may differ by.
struct SkyReach {
  int pixels;
  float most;
};
constexpr SkyReach kNarrow{2, 5.0f};
constexpr SkyReach kWide{SkySquare::kReach, 4.0f};

/// 1 where a pixel shows the same surface as another, else 0.
[[gnu::always_inline]] inline float isSameSurface(const SkySquare& square, std::size_t other, std::size_t pixel) {
  const float x = square.point[0][other] - square.point[0][pixel];
  const float y = square.point[1][other] - square.point[1][pixel];
  const float z = square.point[2][other] - square.point[2][pixel];
  const float nx = square.normal[0][pixel];
  const float ny = square.normal[1][pixel];
  const float nz = square.normal[2][pixel];
  const float along = x * nx + y * ny + z * nz;
  const float cosine = square.normal[0][other] * nx + square.normal[1][other] * ny + square.normal[2][other] * nz;
  const int same = square.shows[other] & (along * along <= kSkyFlat * (x * x + y * y + z * z) ? -1 : 0) &
                   (cosine >= kSkyLeastCosine ? -1 : 0);
  return same != 0 ? 1.0f : 0.0f;
}

/// Weighted sums over the pixels of one surface around each pixel of a row.
struct Weighted {
  alignas(64) float one[kRow], x[kRow], y[kRow], xx[kRow], xy[kRow], yy[kRow], squared[kRow];
};
struct OfShare {
  alignas(64) float sum[kRow], byX[kRow], byY[kRow];
};

[[gnu::always_inline]] inline void clear(Weighted& sums) {
  for (std::size_t i = 0; i < kRow; ++i) {
    sums.one[i] = sums.x[i] = sums.y[i] = sums.xy[i] = sums.squared[i] = 0;
    sums.xx[i] = sums.yy[i] = kSkyFewest;
  }
}
[[gnu::always_inline]] inline void clear(OfShare& sums) {
  for (std::size_t i = 0; i < kRow; ++i) sums.sum[i] = sums.byX[i] = sums.byY[i] = 0;
}

/// A plane through shares, as the share at the pixel itself and what it takes of others.
struct Slope {
  alignas(64) float x[kRow], y[kRow], xx[kRow], xy[kRow], yy[kRow], over[kRow];
};

[[gnu::always_inline]] inline void momentsOf(const Weighted& sums, Slope& slope) {
  for (std::size_t i = 0; i < kRow; ++i) {
    const float over = sums.one[i] > 0 ? 1 / sums.one[i] : 0.0f;
    const float x = sums.x[i] * over;
    const float y = sums.y[i] * over;
    const float xx = sums.xx[i] * over - x * x + kSkyFewest;
    const float xy = sums.xy[i] * over - x * y;
    const float yy = sums.yy[i] * over - y * y + kSkyFewest;
    const float determinant = 1 / (xx * yy - xy * xy);
    slope.over[i] = over;
    slope.x[i] = x;
    slope.y[i] = y;
    slope.xx[i] = xx * determinant;
    slope.xy[i] = xy * determinant;
    slope.yy[i] = yy * determinant;
  }
}

struct Fit {
  alignas(64) float plane[kRow], explained[kRow]; ///< share; sum of squares that the slope explains, a weight
};

[[gnu::always_inline]] inline void fit(const Slope& slope, const OfShare& sums, Fit& found) {
  for (std::size_t i = 0; i < kRow; ++i) {
    const float mean = sums.sum[i] * slope.over[i];
    const float byX = sums.byX[i] * slope.over[i] - slope.x[i] * mean;
    const float byY = sums.byY[i] * slope.over[i] - slope.y[i] * mean;
    const float slopeX = slope.yy[i] * byX - slope.xy[i] * byY;
    const float slopeY = slope.xx[i] * byY - slope.xy[i] * byX;
    const float there = mean - slopeX * slope.x[i] - slopeY * slope.y[i];
    found.plane[i] = there < 0 ? 0.0f : there > 1 ? 1.0f : there;
    found.explained[i] = mean * mean + slopeX * byX + slopeY * byY;
  }
}

/// The diffuse shares, and the mirrored ones: each with weights of its own.
struct Sums {
  Weighted diffuse, mirrored;
  OfShare share[4];
  alignas(64) float squares[2][kRow];
};

[[gnu::always_inline]] inline void add(const SkySquare& square, std::size_t first, int right, int up, float part,
                                       Sums& sums) {
  const auto to = static_cast<std::size_t>(up * SkySquare::kWidth + right);
  const auto x = static_cast<float>(right);
  const auto y = static_cast<float>(up);
  for (std::size_t i = 0; i < kRow; ++i) {
    const std::size_t other = first + i + to;
    const float same = part * isSameSurface(square, other, first + i);
    const float one = same * square.weight[other];
    const float mirror = same * square.mirror[other];
    const auto addTo = [&](Weighted& w, float by) {
      w.one[i] += by;
      w.x[i] += by * x;
      w.y[i] += by * y;
      w.xx[i] += by * x * x;
      w.xy[i] += by * x * y;
      w.yy[i] += by * y * y;
      w.squared[i] += by * by;
    };
    addTo(sums.diffuse, one);
    addTo(sums.mirrored, mirror);
    for (std::size_t c = 0; c < 4; ++c) {
      const float by = (c < 3 ? one : mirror) * square.share[c][other];
      sums.share[c].sum[i] += by;
      sums.share[c].byX[i] += by * x;
      sums.share[c].byY[i] += by * y;
    }
    const float green = square.share[1][other];
    const float alpha = square.share[3][other];
    sums.squares[0][i] += one * green * green;
    sums.squares[1][i] += mirror * alpha * alpha;
  }
}

/// How far shares vary from their plane more than noise would have them: 0 not at all, 1 by far.
[[gnu::always_inline]] inline void beyond(const Weighted& sums, const Fit& found, const float* squares,
                                          const float* noise, float most, float* kept) {
  for (std::size_t i = 0; i < kRow; ++i) {
    const float over = sums.one[i] > 0 ? 1 / sums.one[i] : 0.0f;
    const float pixels = sums.squared[i] > 0 ? sums.one[i] * sums.one[i] / sums.squared[i] : 0.0f;
    const float free = pixels - 3; // a plane takes three
    const float varies = (squares[i] * over - found.explained[i]) * pixels / (free > 0.5f ? free : 0.5f);
    const float plane = found.plane[i];
    const float expected = most * noise[i] * (4 * plane * (1 - plane) + 0.04f);
    const float times = varies / (expected > 1e-9f ? expected : 1e-9f) - 1;
    kept[i] = times > 0 ? (times < 1 ? times : 1.0f) : 0.0f;
  }
}

struct RowShares {
  alignas(64) float share[4][kRow], uneven[kRow];
};

[[gnu::always_inline]] inline void evenBy(const SkySquare& square, std::size_t first, const SkyReach& reach,
                                          RowShares& row) {
  Sums sums;
  clear(sums.diffuse);
  clear(sums.mirrored);
  for (OfShare& share : sums.share) clear(share);
  for (auto& squares : sums.squares) std::fill_n(squares, kRow, 0.0f);
  for (int up = -reach.pixels; up <= reach.pixels; ++up) {
    for (int right = -reach.pixels; right <= reach.pixels; ++right) {
      const float part = (std::abs(right) == reach.pixels ? 0.5f : 1.0f) * (std::abs(up) == reach.pixels ? 0.5f : 1.0f);
      add(square, first, right, up, part, sums);
    }
  }
  Slope slope, mirrorSlope;
  momentsOf(sums.diffuse, slope);
  momentsOf(sums.mirrored, mirrorSlope);
  Fit found[4];
  for (std::size_t c = 0; c < 4; ++c) fit(c < 3 ? slope : mirrorSlope, sums.share[c], found[c]);
  alignas(64) float kept[2][kRow];
  beyond(sums.diffuse, found[1], sums.squares[0], square.noise + first, reach.most, kept[0]);
  beyond(sums.mirrored, found[3], sums.squares[1], square.noise + first, 4 * reach.most, kept[1]);
  for (std::size_t c = 0; c < 4; ++c) {
    const Weighted& weights = c < 3 ? sums.diffuse : sums.mirrored;
    for (std::size_t i = 0; i < kRow; ++i) {
      const float own = kept[c < 3 ? 0 : 1][i];
      const float plane = found[c].plane[i] + own * (row.share[c][i] - found[c].plane[i]);
      row.share[c][i] = weights.one[i] > 0 ? plane : row.share[c][i];
    }
  }
  std::copy_n(kept[0], kRow, row.uneven);
}

GNOMON_FOR_EACH_INSTRUCTION_SET void evenRow(const SkySquare& square, std::size_t first, bool wide, RowShares& row) {
  for (std::size_t c = 0; c < 4; ++c) {
    for (std::size_t i = 0; i < kRow; ++i) row.share[c][i] = square.share[c][first + i];
  }
  evenBy(square, first, kNarrow, row);
  if (wide) evenBy(square, first, kWide, row);
}

} // namespace

EvenSky evenOut(const SkySquare& square, bool wide) {
  EvenSky even;
  for (std::size_t y = 0; y < SkySquare::kSide; ++y) {
    RowShares row;
    evenRow(square, (y + SkySquare::kReach) * SkySquare::kWidth + SkySquare::kReach, wide, row);
    for (std::size_t c = 0; c < 4; ++c) std::copy_n(row.share[c], kRow, even.share[c] + y * kRow);
    std::copy_n(row.uneven, kRow, even.uneven + y * kRow);
  }
  return even;
}

} // namespace gnomon
