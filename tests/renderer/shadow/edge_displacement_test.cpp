#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "renderer/shadow/predicted_error.h"

namespace gnomon {
namespace {

constexpr double kPi = 3.14159265358979;

/// What a lookup weighs a texel centre `apart` texels away with, along an axis: bilinear taps a texel apart.
double weightOf(int taps, double apart) {
  double sum = 0;
  for (int i = 0; i < taps; ++i) sum += std::max(0.0, 1 - std::abs(apart - (i - 0.5 * (taps - 1))));
  return sum / taps;
}

double litShare(int taps, const glm::dvec2& at, const glm::dvec2& normal, double edge) {
  double lit = 0;
  const int reach = taps / 2 + 1;
  for (int y = -reach; y <= reach + 1; ++y) {
    for (int x = -reach; x <= reach + 1; ++x) {
      if (glm::dot(normal, glm::dvec2(x, y)) > edge) lit += weightOf(taps, at.x - x) * weightOf(taps, at.y - y);
    }
  }
  return lit;
}

/// The area between a straight edge and the map's, of each texel of its length, by a grid of places and phases.
double simulated(int taps, double angle) {
  const glm::dvec2 normal(std::cos(angle), std::sin(angle));
  constexpr int kSteps = 24;
  int wrong = 0;
  for (int i = 0; i < kSteps * kSteps * kSteps; ++i) {
    const glm::dvec2 at((i % kSteps + 0.5) / kSteps, (i / kSteps % kSteps + 0.5) / kSteps);
    const double apart = 2 * (i / (kSteps * kSteps) + 0.5) / kSteps - 1;
    wrong += (litShare(taps, at, normal, glm::dot(normal, at) - apart) >= 0.5) != (apart > 0) ? 1 : 0;
  }
  return 2.0 * wrong / (kSteps * kSteps * kSteps);
}

/// The mean of |a x + b y| over a texel.
double simulatedNearest(double angle) {
  constexpr int kSteps = 200;
  double sum = 0;
  for (int i = 0; i < kSteps * kSteps; ++i) {
    sum += std::abs(std::cos(angle) * ((i % kSteps + 0.5) / kSteps - 0.5) +
                    std::sin(angle) * ((i / kSteps + 0.5) / kSteps - 0.5));
  }
  return sum / (kSteps * kSteps);
}

TEST(EdgeDisplacement, H2_AnEdgeAlongTheTexelsIsAQuarterOfOneOffWhateverTheFilter) {
  for (const double taps : {1.0, 3.0, 5.0, 7.0, 20.0}) {
    EXPECT_DOUBLE_EQ(staircase({taps, true}, 0), 0.25);
    EXPECT_DOUBLE_EQ(staircase({taps, false}, 0), 0.25);
  }
  EXPECT_NEAR(simulated(1, 0), 0.25, 0.01);
  EXPECT_NEAR(simulated(5, 0), 0.25, 0.01);
}

TEST(EdgeDisplacement, H2_OfTexelsTakenAsTheyAreItIsTheKnownIntegral) {
  for (int degrees = 0; degrees <= 45; degrees += 5) {
    const double angle = degrees * kPi / 180;
    EXPECT_NEAR(staircase({1, false}, std::tan(angle)), simulatedNearest(angle), 1e-4) << degrees;
  }
}

TEST(EdgeDisplacement, H2_OverAllAnglesItIsWhatFiltersDo) {
  for (const int taps : {1, 3, 5, 7}) {
    double model = 0;
    double truth = 0;
    for (double degrees = 0.5; degrees < 45; degrees += 1) {
      model += staircase({static_cast<double>(taps), true}, std::tan(degrees * kPi / 180));
      truth += simulated(taps, degrees * kPi / 180);
    }
    EXPECT_NEAR(model / truth, 1, 0.1) << taps;
  }
}

TEST(EdgeDisplacement, H2_WithoutATexelItIsTheShiftAcrossTheEdge) {
  const MapReading hard;
  const glm::dvec2 across(0.6, 0.8);
  EXPECT_NEAR(expectedDisplacement({across, {}, {}, {1, 0}}, hard), 0.6, 1e-12);
  EXPECT_NEAR(expectedDisplacement({across, {}, {}, {-1, 0}}, hard), 0.6, 1e-12);
  EXPECT_NEAR(expectedDisplacement({across, {}, {}, {0.8, -0.6}}, hard), 0, 1e-12) << "along the edge";
}

TEST(EdgeDisplacement, H2_ATexelAcrossTheEdgeAndAShiftAddUpAsOverAnInterval) {
  const MapReading hard;
  for (const double texel : {0.5, 1.0, 2.0}) {
    const double reach = texel / 2; // the edge lies anywhere in a texel
    EXPECT_NEAR(expectedDisplacement({{1, 0}, {texel, 0}, {0, 9}, {}}, hard), texel / 4, 1e-12);
    EXPECT_NEAR(expectedDisplacement({{1, 0}, {texel, 0}, {0, 9}, {0.2, 0}}, hard),
                (0.04 + reach * reach) / (2 * reach), 1e-12);
    EXPECT_NEAR(expectedDisplacement({{1, 0}, {texel, 0}, {0, 9}, {reach + 0.1, 0}}, hard), reach + 0.1, 1e-12)
        << "as often too far as too near";
  }
  EXPECT_NEAR(expectedDisplacement({{0, 1}, {0, 2}, {7, 0}, {}}, hard), 0.5, 1e-12) << "seen the other way";
}

TEST(EdgeDisplacement, H2_FartherThanTheBandAndTheNextEdgeNothingCounts) {
  const MapReading hard;
  EXPECT_NEAR(expectedDisplacement({{1, 0}, {}, {}, {40, 0}}, hard), 3, 1e-12) << "2 pixels and the edge's own";
  const double half = std::sqrt(0.5);
  EXPECT_NEAR(expectedDisplacement({{half, half}, {}, {}, {40, 0}}, hard), 2 + half, 1e-12);
  EXPECT_NEAR(expectedDisplacement({{1, 0}, {}, {}, {40, 0}, 1}, hard), 1, 1e-12);
  // Uniform over -10..10: (2 * 3 * 3 / 2 + 14 * 3) / 20.
  EXPECT_NEAR(expectedDisplacement({{1, 0}, {20, 0}, {}, {}}, hard), 2.55, 1e-12);
  EXPECT_NEAR(expectedDisplacement({{1, 0}, {1e-9, 0}, {}, {1, 0}}, hard), 1, 1e-9);
}

TEST(EdgeDisplacement, H2_NothingThatIsNotFiniteCounts) {
  const double infinite = std::numeric_limits<double>::infinity();
  EXPECT_EQ(expectedDisplacement({{1, 0}, {infinite, 0}, {}, {}}, {}), 0);
  EXPECT_EQ(expectedDisplacement({{1, 0}, {}, {}, {std::nan(""), 0}}, {}), 0);
  EXPECT_EQ(expectedDisplacement({}, {}), 0);
}

/// Radii: the area between a straight edge and where a disc's comparisons, each one texel soft, put it.
double simulatedScatter(double radius) {
  constexpr int kTaps = 32;
  constexpr int kTurns = 90;
  constexpr int kPlaces = 200;
  int wrong = 0;
  for (int i = 0; i < kTurns * kPlaces; ++i) {
    const double edge = radius * ((i / kTurns + 0.5) / kPlaces - 0.5);
    double lit = 0;
    for (int tap = 0; tap < kTaps; ++tap) {
      const double angle = i % kTurns * 2 * kPi / kTurns + tap * 2.39996323;
      const double along = radius * std::sqrt((tap + 0.5) / kTaps) * std::cos(angle);
      lit += std::clamp(0.5 + along - edge, 0.0, 1.0) / kTaps;
    }
    wrong += (lit >= 0.5) != (edge <= 0) ? 1 : 0;
  }
  return wrong / static_cast<double>(kTurns * kPlaces);
}

TEST(EdgeDisplacement, H2_ADiscsComparisonsMissTheEdgeByAShareOfTheirRadius) {
  for (const double radius : {3.0, 6.0, 12.0, 24.0}) {
    const double ratio = overDisc({}, radius).scatter / (radius * simulatedScatter(radius));
    EXPECT_NEAR(ratio, 1, 0.3) << radius;
  }
}

TEST(EdgeDisplacement, H2_AFiltersTapsAreItsSizeOrItsDiscInTexels) {
  ShadowTile tile;
  tile.space.fit.texelSize = {0.5, 0.25};
  tile.filter = kernelOf({FilterType::hard, 5});
  EXPECT_EQ(readingOf(tile, 1).taps, 1);
  EXPECT_FALSE(readingOf(tile, 4).bilinear);
  tile.filter = kernelOf({FilterType::pcf, 5});
  EXPECT_NEAR(readingOf(tile, 1).taps, std::sqrt(15.0), 1e-12) << "1 3 4 3 1 weighs as four even taps do";
  tile.filter = kernelOf({FilterType::pcf, 5, 2.0});
  tile.space.fit.radius = 2;
  EXPECT_NEAR(readingOf(tile, 1).taps, 1 + std::sqrt(3.0) * 4, 1e-12);
  EXPECT_GT(readingOf(tile, 1).scatter, 0);
  tile.filter = kernelOf({FilterType::pcss}, 2);
  EXPECT_EQ(readingOf(tile, 1).taps, 1) << "its penumbra is another at each pixel";
  tile.filter = kernelOf({FilterType::vsm, 5});
  EXPECT_TRUE(readingOf(tile, 4).bilinear) << "moments are resolved before they are looked up";
}

} // namespace
} // namespace gnomon
