#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <rapidcheck/gtest.h>

#include "renderer/prepare/outlines.h"

namespace gnomon {
namespace {

constexpr int kWidth = 24;
constexpr int kHeight = 16;

glm::dvec4 clipAt(glm::dvec2 texel, double w = 1) {
  return {(texel / glm::dvec2(kWidth, kHeight) * 2.0 - 1.0) * w, 0.5 * w, w};
}

glm::dvec2 anyPlace(double room) {
  const auto number = [&](double side) {
    return -room + (side + 2 * room) * (*rc::gen::inRange(0, 1 << 20)) / double(1 << 20);
  };
  return {number(kWidth), number(kHeight)};
}

double anyW() {
  return std::exp2(*rc::gen::inRange(-20, 20));
}

/// The larger of the distances along x and along y from a cell's middle to the nearest point of a to b, by walking.
double distanceTo(glm::dvec2 centre, glm::dvec2 a, glm::dvec2 b) {
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= 4096; ++i) {
    const glm::dvec2 away = glm::abs(a + (b - a) * (i / 4096.0) - centre);
    least = std::min(least, std::max(away.x, away.y));
  }
  return least;
}

RC_GTEST_PROP(OutlineStamps, AnEdgeMarksTheCellsThatItPassesThroughAndFewMore, ()) {
  const glm::dvec2 a = anyPlace(20);
  const glm::dvec2 b = anyPlace(20);
  Stamps stamps(kWidth, kHeight);
  const double wa = anyW();
  stamps.stampEdge(clipAt(a, wa), clipAt(b, wa));
  const std::vector<std::uint8_t> texels = stamps.take();
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const double distance = distanceTo({x + 1.0, y + 1.0}, a, b);
      const bool marked = texels[static_cast<std::size_t>(y * kWidth + x)] == 255;
      if (distance < 0.5) RC_ASSERT(marked);
      if (distance > 1.1) RC_ASSERT(!marked);
    }
  }
}

RC_GTEST_PROP(OutlineStamps, ATriangleMarksTheBoxAroundIt, ()) {
  const glm::dvec2 a = anyPlace(5), b = anyPlace(5), c = anyPlace(5);
  Stamps stamps(kWidth, kHeight);
  stamps.stampTriangle(clipAt(a, anyW()), clipAt(b, anyW()), clipAt(c, anyW()));
  const std::vector<std::uint8_t> texels = stamps.take();
  const glm::dvec2 lowest = glm::min(a, glm::min(b, c)) - 0.5;
  const glm::dvec2 highest = glm::max(a, glm::max(b, c)) + 0.5;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const glm::dvec2 centre(x + 1.0, y + 1.0);
      const bool within = glm::all(glm::greaterThan(centre, lowest)) && glm::all(glm::lessThan(centre, highest));
      if (within) RC_ASSERT(texels[static_cast<std::size_t>(y * kWidth + x)] == 255);
    }
  }
}

TEST(OutlineStamps, AnEdgeThatComesFromBehindTheLightIsCutOff) {
  Stamps stamps(kWidth, kHeight);
  // Half a turn round the light: only what lies before it counts, out to the tile's right end.
  stamps.stampEdge(clipAt({12, 8}, 2.0), {2.0, 0.0, 0.0, -1.0});
  const std::vector<std::uint8_t> texels = stamps.take();
  EXPECT_EQ(texels[7 * kWidth + 12], 255);
  EXPECT_EQ(texels[7 * kWidth + 22], 255);
  EXPECT_EQ(texels[7 * kWidth + 4], 0);
  EXPECT_EQ(texels[2 * kWidth + 12], 0);
}

TEST(OutlineStamps, WhatLiesBehindTheLightOrNowhereMarksNothing) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Stamps stamps(kWidth, kHeight);
  stamps.stampEdge({0, 0, 0, -1}, {0.5, 0, 0, -2});
  stamps.stampEdge({nan, 0, 0, 1}, {0, 0, 0, 1});
  stamps.stampEdge({0, 0, 0, nan}, {0, 0, 0, 1});
  stamps.stampTriangle({nan, 0, 0, 1}, {0, 0, 0, 1}, {1, 1, 0, 1});
  stamps.stampTriangle({0, 0, 0, -1}, {0, 0, 0, -1}, {1, 1, 0, -1});
  for (const std::uint8_t texel : stamps.take()) EXPECT_EQ(texel, 0);
}

} // namespace
} // namespace gnomon
