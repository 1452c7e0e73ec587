#include "renderer/techniques/sky_square.h"

#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace gnomon {
namespace {

/// A flat floor: shares with an edge, noise, and pixels of which nothing is known.
SkySquare noisyFloor(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> unit(0, 1);
  SkySquare square{};
  for (std::size_t i = 0; i < SkySquare::kCount; ++i) {
    const auto x = static_cast<float>(i % SkySquare::kWidth);
    const auto y = static_cast<float>(i / SkySquare::kWidth);
    for (auto& share : square.share) share[i] = std::min(1.0f, 0.3f * unit(random) + (x > 11 ? 0.7f : 0.02f * y));
    square.weight[i] = unit(random) < 0.1f ? 0.0f : 0.5f + unit(random);
    square.mirror[i] = unit(random);
    square.noise[i] = 0.01f + 0.02f * unit(random);
    square.point[0][i] = 0.01f * x;
    square.point[2][i] = 0.01f * y;
    square.normal[1][i] = 1;
    square.shows[i] = -1;
  }
  return square;
}

TEST(SkySquare, OneSurfaceIsWhatComparedPairsFind) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    SkySquare square = noisyFloor(seed);
    for (const bool wide : {false, true}) {
      square.oneSurface = false;
      const EvenSky pairs = evenOut(square, wide);
      square.oneSurface = true;
      const EvenSky rows = evenOut(square, wide);
      for (std::size_t i = 0; i < SkySquare::kOwn; ++i) {
        for (std::size_t c = 0; c < 4; ++c) ASSERT_NEAR(rows.share[c][i], pairs.share[c][i], 2e-4) << c << ' ' << i;
        ASSERT_NEAR(rows.uneven[i], pairs.uneven[i], 2e-3) << i;
      }
    }
  }
}

TEST(SkySquare, AnotherSurfaceIsLeftOut) {
  SkySquare square = noisyFloor(1);
  for (std::size_t i = 0; i < SkySquare::kCount; ++i) {
    const bool wall = i % SkySquare::kWidth > 11;
    for (auto& share : square.share) share[i] = wall ? 0.9f : 0.2f;
    square.normal[0][i] = wall ? 1.0f : 0.0f;
    square.normal[1][i] = wall ? 0.0f : 1.0f;
  }
  square.oneSurface = false;
  const EvenSky even = evenOut(square, true);
  for (std::size_t i = 0; i < SkySquare::kOwn; ++i) {
    const bool wall = i % SkySquare::kSide + SkySquare::kReach > 11;
    EXPECT_NEAR(even.share[1][i], wall ? 0.9f : 0.2f, 1e-4) << i;
  }
}

} // namespace
} // namespace gnomon
