#include "renderer/shadow/slice.h"

#include <algorithm>
#include <gtest/gtest.h>

#include "tests/renderer/shadow/random_plan.h"

namespace gnomon {
namespace {

std::vector<glm::dvec3> corners(const CameraView& view, const DepthInterval& depths) {
  std::vector<glm::dvec3> result;
  for (const double depth : {depths.near, depths.far}) {
    for (const double x : {-1.0, 1.0}) {
      for (const double y : {-1.0, 1.0}) result.push_back(pointAt(view, {x, y}, depth));
    }
  }
  return result;
}

double radiusAround(const glm::dvec3& center, const std::vector<glm::dvec3>& points) {
  double radius = 0;
  for (const glm::dvec3& point : points) radius = std::max(radius, glm::length(point - center));
  return radius;
}

TEST(Slice, X24_M17_TheSphereHoldsTheCornersAndNoneOnTheAxisIsSmaller) {
  EXPECT_TRUE(rc::check([](const RandomView& random, unsigned seed) {
    Dice dice(seed);
    const CameraView& view = random.view;
    const double near = view.near + dice.between(0, 10);
    const DepthInterval depths{near, near + dice.between(0.01, 500)};
    const auto points = corners(view, depths);
    const Sphere sphere = sliceSphere(view, depths);
    RC_ASSERT(std::abs(radiusAround(sphere.center, points) - sphere.radius) < 1e-9 * sphere.radius);
    for (int i = 0; i <= 100; ++i) {
      const double depth = depths.near + (depths.far - depths.near) * i / 100.0;
      RC_ASSERT(radiusAround(view.forward * depth, points) > sphere.radius * (1 - 1e-9));
    }
  }));
}

TEST(Slice, X24_TheSphereIsSmallerThanTheOneAroundTheCornersMean) {
  CameraView view; // fov 45, 1:1, as the row computes
  view.halfSize = glm::dvec2(std::tan(glm::radians(22.5)));
  const DepthInterval depths{0.1, 50};
  const auto points = corners(view, depths);
  glm::dvec3 mean(0);
  for (const glm::dvec3& point : points) mean += point / 8.0;
  const double ratio = radiusAround(mean, points) / sliceSphere(view, depths).radius;
  EXPECT_GT(ratio, 1.01);
  EXPECT_LT(ratio, 1.16);
}

TEST(Slice, ReachIsTheFarthestCorner) {
  EXPECT_TRUE(rc::check([](const RandomView& random, const RandomUnit& unit) {
    const DepthInterval depths{random.view.near, random.view.near + 100 * unit.value + 0.1};
    const double farthest = radiusAround(glm::dvec3(0), corners(random.view, depths));
    RC_ASSERT(std::abs(sliceReach(random.view, depths) - farthest) < 1e-9 * farthest);
  }));
}

} // namespace
} // namespace gnomon
