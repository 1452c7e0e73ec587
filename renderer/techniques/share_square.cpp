#include "renderer/techniques/share_square.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "renderer/core/instruction_sets.h"
#include "renderer/techniques/same_surface.h"

namespace gnomon {
namespace {

constexpr std::size_t kRowLength = ShareSquare::kSide; ///< pixels
constexpr std::size_t kUp = ShareSquare::kWidth;       ///< from a pixel to the one above

constexpr SurfaceLimits kBeside{.flat = 0.01f, .leastCosine = 0.9f};
constexpr float kLeastVariance = 1e-9f;
constexpr float kFewest = 1e-3f; ///< squared pixels; without a second direction there is no slope

/// Squared differences of pixels from the mean of two of their surface beside them: the sum, and how many.
struct Differences {
  alignas(64) float sum[ShareSquare::kCount], count[ShareSquare::kCount];
};

GNOMON_FOR_EACH_INSTRUCTION_SET void findDifferences(const ShareSquare& square, Differences& differences) {
  for (std::size_t i = 0; i < ShareSquare::kCount; ++i) {
    differences.sum[i] = 0;
    differences.count[i] = 0;
  }
  for (const std::size_t step : {std::size_t{1}, kUp}) {
    for (std::size_t i = kUp + 1; i < ShareSquare::kCount - kUp - 1; ++i) {
      const int same =
          square.shows[i] & showsSame(square, i - step, i, kBeside) & showsSame(square, i + step, i, kBeside);
      const float off = square.share[i] - 0.5f * (square.share[i - step] + square.share[i + step]);
      differences.sum[i] += same != 0 ? off * off : 0.0f;
      differences.count[i] += same != 0 ? 1.0f : 0.0f;
    }
  }
}

/// How far around a pixel shares are asked for, and how many times noise's variance they may differ by.
struct Reach {
  int pixels;
  float most;
};
constexpr Reach kReaches[] = {{1, 3.0f}, {ShareSquare::kReach, 2.0f}};

/// Sums over the pixels of one surface around each pixel of a row: of their weights, and of those times where they lie
/// from the pixel and what share they have.
struct RowSums {
  alignas(64) float one[kRowLength], x[kRowLength], y[kRowLength], xx[kRowLength], xy[kRowLength], yy[kRowLength];
  float share[kRowLength], shareX[kRowLength], shareY[kRowLength], squares[kRowLength];
};

/// The pixels of the row themselves, which have no slope.
[[gnu::always_inline]] inline RowSums ownSums(const ShareSquare& square, std::size_t first) {
  RowSums sums{};
  for (std::size_t i = 0; i < kRowLength; ++i) {
    const float own = square.share[first + i];
    sums.one[i] = 1;
    sums.xx[i] = kFewest;
    sums.yy[i] = kFewest;
    sums.share[i] = own;
    sums.squares[i] = own * own;
  }
  return sums;
}

/// Adds the pixels that lie so far from those of the row.
[[gnu::always_inline]] inline void add(const ShareSquare& square, std::size_t first, int right, int up, float part,
                                       RowSums& sums) {
  const auto to = static_cast<std::size_t>(up * ShareSquare::kWidth + right);
  const auto x = static_cast<float>(right);
  const auto y = static_cast<float>(up);
  for (std::size_t i = 0; i < kRowLength; ++i) {
    const std::size_t pixel = first + i;
    const float share = square.share[pixel + to];
    const float one = showsSame(square, pixel + to, pixel, kBeside) != 0 ? part : 0.0f;
    sums.one[i] += one;
    sums.x[i] += one * x;
    sums.y[i] += one * y;
    sums.xx[i] += one * x * x;
    sums.xy[i] += one * x * y;
    sums.yy[i] += one * y * y;
    sums.share[i] += one * share;
    sums.shareX[i] += one * share * x;
    sums.shareY[i] += one * share * y;
    sums.squares[i] += one * share * share;
  }
}

/// Those farthest off count by halves.
[[gnu::always_inline]] inline RowSums sumsAround(const ShareSquare& square, std::size_t first, int reach) {
  RowSums sums = ownSums(square, first);
  for (int up = -reach; up <= reach; ++up) {
    for (int right = -reach; right <= reach; ++right) {
      if (right == 0 && up == 0) continue;
      const float part = (std::abs(right) == reach ? 0.5f : 1.0f) * (std::abs(up) == reach ? 0.5f : 1.0f);
      add(square, first, right, up, part, sums);
    }
  }
  return sums;
}

/// Brings the shares of a row closer to planes through those around (least squares). `noise`: its variance at a share
/// of a half, as rays explain it; `measured`: as neighbours show it.
[[gnu::always_inline]] inline void fit(const RowSums& sums, const float* noise, const float* measured, float most,
                                       float* shares) {
  for (std::size_t i = 0; i < kRowLength; ++i) {
    const float over = 1 / sums.one[i];
    const float x = sums.x[i] * over;
    const float y = sums.y[i] * over;
    const float mean = sums.share[i] * over;
    const float xx = sums.xx[i] * over - x * x;
    const float xy = sums.xy[i] * over - x * y;
    const float yy = sums.yy[i] * over - y * y;
    const float shareX = sums.shareX[i] * over - x * mean;
    const float shareY = sums.shareY[i] * over - y * mean;
    const float determinant = xx * yy - xy * xy;
    const float slopeX = (yy * shareX - xy * shareY) / determinant;
    const float slopeY = (xx * shareY - xy * shareX) / determinant;
    const float squares = sums.squares[i] * over - mean * mean - slopeX * shareX - slopeY * shareY;
    const float free = sums.one[i] - 3; // a plane takes three
    const float varies = squares * sums.one[i] / (free > 0.5f ? free : 0.5f);
    const float there = mean - slopeX * x - slopeY * y;
    const float plane = there < 0 ? 0.0f : there > 1 ? 1.0f : there;
    const float explained = noise[i] * 4 * plane * (1 - plane);
    const float expected = most * (measured[i] < explained ? measured[i] : explained);
    const float beyond = varies / (expected > kLeastVariance ? expected : kLeastVariance) - 1;
    const float kept = beyond < 0 ? 0.0f : beyond > 1 ? 1.0f : beyond;
    shares[i] = plane + kept * (shares[i] - plane);
  }
}

GNOMON_FOR_EACH_INSTRUCTION_SET void evenRow(const ShareSquare& square, const Differences& differences,
                                             std::size_t first, float* shares) {
  alignas(64) float measured[kRowLength];
  for (std::size_t i = 0; i < kRowLength; ++i) {
    float sum = 0;
    float count = 0;
    for (std::size_t row = first + i - kUp; row <= first + i + kUp; row += kUp) {
      sum += differences.sum[row - 1] + differences.sum[row] + differences.sum[row + 1];
      count += differences.count[row - 1] + differences.count[row] + differences.count[row + 1];
    }
    // The mean of two differs from a third by 3/2 of their variance.
    measured[i] = sum / (count > 0 ? 1.5f * count : 1.0f);
    shares[i] = square.share[first + i];
  }
  for (const Reach& reach : kReaches) {
    fit(sumsAround(square, first, reach.pixels), square.noise + first, measured, reach.most, shares);
  }
}

} // namespace

float noiseOf(int rays) {
  const auto n = static_cast<float>(rays);
  return 1.3f / 6 / (n * std::sqrt(n));
}

EvenSquare evenOut(const ShareSquare& square) {
  Differences differences;
  findDifferences(square, differences);
  EvenSquare even;
  for (std::size_t row = 0; row < kRowLength; ++row) {
    const std::size_t first = (row + ShareSquare::kReach) * kUp + ShareSquare::kReach;
    const float* noise = square.noise + first;
    if (std::all_of(noise, noise + kRowLength, [](float variance) { return variance == 0; })) continue;
    evenRow(square, differences, first, even.share + row * kRowLength);
  }
  return even;
}

} // namespace gnomon
