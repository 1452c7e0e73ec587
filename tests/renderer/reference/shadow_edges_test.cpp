#include "renderer/reference/shadow_edges.h"

#include <cmath>
#include <gtest/gtest.h>

#include "tests/renderer/reference/made_reference.h"

namespace gnomon {
namespace {

using testing::pictureOf;
using testing::planeReference;

double lengthOf(int width, int height, const std::vector<float>& values) {
  const Reference truth = planeReference(width, height, values);
  return edgeLength(truth, surfaceLinks(truth), truth.lights[0].receiver, values);
}

constexpr double kPi = 3.14159265358979;

TEST(EdgeLength, UprightAndLevelEdgesAreExact) {
  EXPECT_DOUBLE_EQ(lengthOf(20, 30, testing::litLeftOf(20, 30, 9)), 30.0);
  EXPECT_DOUBLE_EQ(lengthOf(20, 30, pictureOf(20, 30, [](int, int y) { return y < 4 ? 0.0f : 1.0f; })), 20.0);
}

TEST(EdgeLength, ASlantedEdgeIsAsLongAsIfItWereDrawn) {
  constexpr int kSize = 300;
  for (int degrees = 0; degrees < 180; degrees += 3) {
    const glm::dvec2 normal(std::cos(degrees * kPi / 180), std::sin(degrees * kPi / 180));
    // A disc's diameter: the same length at every angle.
    Reference truth = planeReference(kSize, kSize, pictureOf(kSize, kSize, [&](int x, int y) {
                                       return glm::dot(normal, glm::dvec2(x - 149.7, y - 150.4)) > 0 ? 1.0f : 0.0f;
                                     }));
    const auto inDisc =
        pictureOf(kSize, kSize, [](int x, int y) { return std::hypot(x - 149.7, y - 150.4) < 140 ? 1.0f : 0.0f; });
    for (std::size_t i = 0; i < inDisc.size(); ++i) truth.lights[0].receiver[i] = inDisc[i] > 0 ? 1 : 0;
    const auto& light = truth.lights[0];
    EXPECT_NEAR(edgeLength(truth, surfaceLinks(truth), light.receiver, light.visibility), 280, 0.015 * 280) << degrees;
  }
}

TEST(EdgeLength, ACirclesEdgeIsItsCircumference) {
  for (const double radius : {6.0, 20.0, 90.0}) {
    const auto circle =
        pictureOf(200, 200, [radius](int x, int y) { return std::hypot(x - 99.3, y - 100.1) < radius ? 0.0f : 1.0f; });
    EXPECT_NEAR(lengthOf(200, 200, circle), 2 * kPi * radius, 0.015 * 2 * kPi * radius) << radius;
  }
}

TEST(EdgeLength, NothingAsksForMoreThanOnePixel) {
  EXPECT_EQ(lengthOf(1, 1, {1.0f}), 0.0);
  EXPECT_EQ(lengthOf(2, 1, {1.0f, 0.0f}), 1.0);
  EXPECT_EQ(lengthOf(1, 3, {1.0f, 0.0f, 1.0f}), 2.0) << "as much light on either side: the sides count whole";
}

} // namespace
} // namespace gnomon
