#include "renderer/techniques/sky_square.h"

#include <algorithm>

#include "renderer/core/instruction_sets.h"
#include "renderer/techniques/sky_sums.h"

namespace gnomon {
namespace sky_sums {
namespace {

/// How far around a pixel shares are asked for, and how many times noise's variance they may differ by.
struct SkyReach {
  int pixels;
  float most;
};
constexpr SkyReach kNarrow{2, 5.0f};
constexpr SkyReach kWide{SkySquare::kReach, 4.0f};

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

/// How far shares vary from their plane more than noise would have them: 0 not at all, 1 by far.
[[gnu::always_inline]] inline void beyond(const Weighted& sums, const Fit& found, const float* squares,
                                          const float* noise, float most, float* kept) {
  for (std::size_t i = 0; i < kRow; ++i) {
    const float over = sums.one[i] > 0 ? 1 / sums.one[i] : 0.0f;
    const float pixels = sums.squared[i] > 0 ? sums.one[i] * sums.one[i] / sums.squared[i] : 0.0f;
    const float free = pixels - 3; // a plane takes three
    const float varies = (squares[i] * over - found.explained[i]) * pixels / (free > 0.5f ? free : 0.5f);
    const float plane = found.plane[i];
    const float expected = most * noise[i] * over * (4 * plane * (1 - plane) + 0.04f);
    const float times = varies / (expected > 1e-9f ? expected : 1e-9f) - 1;
    kept[i] = times > 0 ? (times < 1 ? times : 1.0f) : 0.0f;
  }
}

struct RowShares {
  alignas(64) float share[4][kRow], uneven[kRow];
};

/// The sums of all rows of a square, for each reach: where all pixels show one surface, first along rows, then across.
struct SquareSums {
  RowSums narrow[SkySquare::kWidth], wide[SkySquare::kWidth];
};

GNOMON_FOR_EACH_INSTRUCTION_SET void addAlongRows(const SkySquare& square, bool wide, SquareSums& sums) {
  addRows(square, kNarrow.pixels, sums.narrow);
  if (wide) addRows(square, kWide.pixels, sums.wide);
}

[[gnu::always_inline]] inline void evenBy(const Sums& sums, float most, RowShares& row) {
  Slope slope, mirrorSlope;
  momentsOf(sums.diffuse, slope);
  momentsOf(sums.mirrored, mirrorSlope);
  Fit found[4];
  for (std::size_t c = 0; c < 4; ++c) fit(c < 3 ? slope : mirrorSlope, sums.share[c], found[c]);
  alignas(64) float kept[2][kRow];
  beyond(sums.diffuse, found[1], sums.squares[0], sums.noise[0], most, kept[0]);
  beyond(sums.mirrored, found[3], sums.squares[1], sums.noise[1], 4 * most, kept[1]);
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

[[gnu::always_inline]] inline void ownShares(const SkySquare& square, std::size_t first, RowShares& row) {
  for (std::size_t c = 0; c < 4; ++c) std::copy_n(square.share[c] + first, kRow, row.share[c]);
}

GNOMON_FOR_EACH_INSTRUCTION_SET void evenRow(const SkySquare& square, std::size_t first, bool wide, RowShares& row) {
  ownShares(square, first, row);
  Sums sums;
  clear(sums);
  addAll(square, first, kNarrow.pixels, sums);
  evenBy(sums, kNarrow.most, row);
  if (!wide) return;
  clear(sums);
  addAll(square, first, kWide.pixels, sums);
  evenBy(sums, kWide.most, row);
}

/// The same where all pixels of the square show one surface. `y`: the row's, from the lowest of the square's own.
GNOMON_FOR_EACH_INSTRUCTION_SET void evenRowOfOne(const SkySquare& square, const SquareSums& rows, std::size_t y,
                                                  bool wide, RowShares& row) {
  const std::size_t first = (y + SkySquare::kReach) * SkySquare::kWidth + SkySquare::kReach;
  ownShares(square, first, row);
  Sums sums;
  clear(sums);
  addAcross(rows.narrow, y + SkySquare::kReach, kNarrow.pixels, sums);
  evenBy(sums, kNarrow.most, row);
  if (!wide) return;
  clear(sums);
  addAcross(rows.wide, y + SkySquare::kReach, kWide.pixels, sums);
  evenBy(sums, kWide.most, row);
}

} // namespace
} // namespace sky_sums

EvenSky evenOut(const SkySquare& square, bool wide) {
  EvenSky even;
  sky_sums::SquareSums rows;
  if (square.oneSurface) sky_sums::addAlongRows(square, wide, rows);
  for (std::size_t y = 0; y < SkySquare::kSide; ++y) {
    sky_sums::RowShares row;
    if (square.oneSurface) {
      sky_sums::evenRowOfOne(square, rows, y, wide, row);
    } else {
      sky_sums::evenRow(square, (y + SkySquare::kReach) * SkySquare::kWidth + SkySquare::kReach, wide, row);
    }
    for (std::size_t c = 0; c < 4; ++c) std::copy_n(row.share[c], sky_sums::kRow, even.share[c] + y * sky_sums::kRow);
    std::copy_n(row.uneven, sky_sums::kRow, even.uneven + y * sky_sums::kRow);
  }
  return even;
}

} // namespace gnomon
