#include "renderer/techniques/share_square.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "renderer/core/instruction_sets.h"

namespace gnomon {
namespace {

constexpr std::size_t kRow = ShareSquare::kSide; ///< pixels
constexpr std::size_t kUp = ShareSquare::kWidth; ///< from a pixel to the one above

constexpr float kFlat = 0.01f;       ///< squared sine of the steepest way from a pixel to one of the same surface
constexpr float kLeastCosine = 0.9f; ///< of their normals
constexpr float kLeastVariance = 1e-9f;

/// Whether a pixel shows the same surface as another: -1, or 0.
[[gnu::always_inline]] inline int isBeside(const ShareSquare& square, std::size_t other, std::size_t pixel) {
  const float x = square.point[0][other] - square.point[0][pixel];
  const float y = square.point[1][other] - square.point[1][pixel];
  const float z = square.point[2][other] - square.point[2][pixel];
  const float nx = square.normal[0][pixel];
  const float ny = square.normal[1][pixel];
  const float nz = square.normal[2][pixel];
  const float along = x * nx + y * ny + z * nz;
  const float cosine = square.normal[0][other] * nx + square.normal[1][other] * ny + square.normal[2][other] * nz;
  return square.shows[other] & (along * along <= kFlat * (x * x + y * y + z * z) ? -1 : 0) &
         (cosine >= kLeastCosine ? -1 : 0);
}

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
      const int same = square.shows[i] & isBeside(square, i - step, i) & isBeside(square, i + step, i);
      const float off = square.share[i] - 0.5f * (square.share[i - step] + square.share[i + step]);
      differences.sum[i] += same != 0 ? off * off : 0.0f;
      differences.count[i] += same != 0 ? 1.0f : 0.0f;
    }
  }
}

/// Over the pixels of one surface around each pixel of a row.
struct RowSums {
  alignas(64) float share[kRow], squares[kRow], weight[kRow];
};

/// Adds the pixels `to` off those from `first` on, and those opposite.
[[gnu::always_inline]] inline void addPair(const ShareSquare& square, std::size_t first, std::size_t to, float part,
                                           RowSums& sums) {
  for (std::size_t x = 0; x < kRow; ++x) {
    const std::size_t pixel = first + x;
    const int same = isBeside(square, pixel - to, pixel) & isBeside(square, pixel + to, pixel);
    const float a = square.share[pixel - to];
    const float b = square.share[pixel + to];
    const float counted = same != 0 ? part : 0.0f;
    sums.share[x] += counted * (a + b);
    sums.squares[x] += counted * (a * a + b * b);
    sums.weight[x] += 2 * counted;
  }
}

GNOMON_FOR_EACH_INSTRUCTION_SET RowSums sumsAround(const ShareSquare& square, std::size_t first) {
  RowSums sums;
  for (std::size_t x = 0; x < kRow; ++x) {
    const float own = square.share[first + x];
    sums.share[x] = own;
    sums.squares[x] = own * own;
    sums.weight[x] = 1;
  }
  constexpr int kFar = ShareSquare::kReach;
  for (int dy = 0; dy <= kFar; ++dy) {
    for (int dx = dy == 0 ? 1 : -kFar; dx <= kFar; ++dx) {
      const float part = (std::abs(dx) == kFar ? 0.5f : 1.0f) * (dy == kFar ? 0.5f : 1.0f);
      addPair(square, first, static_cast<std::size_t>(dy * ShareSquare::kWidth + dx), part, sums);
    }
  }
  return sums;
}

GNOMON_FOR_EACH_INSTRUCTION_SET void evenRow(const ShareSquare& square, const Differences& differences,
                                             std::size_t first, float most, float* share) {
  const RowSums sums = sumsAround(square, first);
  for (std::size_t x = 0; x < kRow; ++x) {
    float sum = 0;
    float count = 0;
    for (std::size_t row = first + x - kUp; row <= first + x + kUp; row += kUp) {
      sum += differences.sum[row - 1] + differences.sum[row] + differences.sum[row + 1];
      count += differences.count[row - 1] + differences.count[row] + differences.count[row + 1];
    }
    const float mean = sums.share[x] / sums.weight[x];
    const float varies = sums.squares[x] / sums.weight[x] - mean * mean;
    // The mean of two differs from a third by 3/2 of their variance.
    const float measured = sum / (count > 0 ? 1.5f * count : 1.0f);
    const float explained = square.noise[first + x] * 4 * mean * (1 - mean);
    const float expected = most * (measured < explained ? measured : explained);
    const float beyond = varies / (expected > kLeastVariance ? expected : kLeastVariance) - 1;
    const float kept = beyond < 0 ? 0.0f : beyond > 1 ? 1.0f : beyond;
    share[x] = mean + kept * (square.share[first + x] - mean);
  }
}

} // namespace

float noiseOf(int rays) {
  const auto n = static_cast<float>(rays);
  return 1.3f / 6 / (n * std::sqrt(n));
}

EvenSquare evenOut(const ShareSquare& square, float most) {
  Differences differences;
  findDifferences(square, differences);
  EvenSquare even;
  for (std::size_t row = 0; row < kRow; ++row) {
    const std::size_t first = (row + ShareSquare::kReach) * kUp + ShareSquare::kReach;
    const float* noise = square.noise + first;
    if (std::all_of(noise, noise + kRow, [](float variance) { return variance == 0; })) continue;
    evenRow(square, differences, first, most, even.share + row * kRow);
  }
  return even;
}

} // namespace gnomon
