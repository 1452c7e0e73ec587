#pragma once

#include <cstddef>

namespace gnomon {

/// A square of a picture, and the pixels within kReach of it, row by row from the lowest.
struct ShareSquare {
  static constexpr int kSide = 16;
  static constexpr int kReach = 2;
  static constexpr int kWidth = kSide + 2 * kReach;
  static constexpr std::size_t kCount = static_cast<std::size_t>(kWidth * kWidth);

  alignas(64) float share[kCount]; ///< of a light
  float noise[kCount];             ///< variance that rays would leave in a share of a half (noiseOf); 0 = no matter
  float point[3][kCount];          ///< that a pixel shows, relative to any place
  float normal[3][kCount];         ///< unit length
  int shows[kCount];               ///< -1: a surface that faces the light; else 0, and point and normal mean nothing
};

/// The variance that this many rays leave in a share of a half: an edge of a shadow that crosses a light of n strata
/// passes through about 1.3 n^(1/2) of them, each of which adds 1/6 n^-2 (Mitchell, "Consequences of Stratified
/// Sampling in Graphics", SIGGRAPH 1996).
float noiseOf(int rays);

/// The pixels of the square itself, evened out, row by row.
struct EvenSquare {
  static constexpr std::size_t kCount = ShareSquare::kSide * ShareSquare::kSide;

  alignas(64) float share[kCount];
};

/// Fits planes to the shares of one surface around each pixel, so that no slope changes them: first over 3 x 3 pixels,
/// then over 5 x 5, of which every fourth along a row or a column counts as much as any other fourth. A pixel takes the
/// plane's share where those around vary from it as noise would have them, its own where they vary by much more, and
/// between, some of both. Noise is what the differences of neighbours measure, and no more than their rays explain.
/// Rows without noise are left out.
EvenSquare evenOut(const ShareSquare& square);

} // namespace gnomon
