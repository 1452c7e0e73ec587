#include "renderer/volume/volume_space.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <rapidcheck.h>

#include "tests/renderer/volume/media.h"

namespace gnomon {
namespace {

TEST(VolumeSpace, WhatIsInsideIsBetweenWhereTheRayEntersAndLeaves) {
  EXPECT_TRUE(rc::check([](unsigned seed) {
    Chances chances(seed);
    const VolumeSpace space = turnedSpace(1e6 * chances.direction(), 0.1 + 50.0 * chances.place(),
                                          chances.between(0, 7), chances.direction());
    const glm::dvec3 inside = toWorld(space, chances.place());
    const Ray ray{inside - chances.between(-200, 200) * chances.direction(), chances.direction()};
    const auto crossed = insideUnitCube(toUnit(space, ray));
    for (int i = -300; i <= 300; ++i) {
      const glm::dvec3 unit = pointAt(toUnit(space, ray), i);
      const glm::dvec3 depth = glm::min(unit, 1.0 - unit);
      const double least = std::min({depth.x, depth.y, depth.z});
      if (std::abs(least) < 1e-6) continue;
      RC_ASSERT((least > 0) == (crossed && crossed->from <= i && i <= crossed->to));
    }
  }));
}

TEST(VolumeSpace, DistancesAlongARayAreMetres) {
  EXPECT_TRUE(rc::check([](unsigned seed) {
    Chances chances(seed);
    const VolumeSpace space = turnedSpace(1e6 * chances.direction(), 0.1 + 50.0 * chances.place(),
                                          chances.between(0, 7), chances.direction());
    const Ray ray{toWorld(space, chances.place()), chances.direction()};
    const double distance = chances.between(-100, 100);
    const glm::dvec3 apart = toWorld(space, pointAt(toUnit(space, ray), distance)) - pointAt(ray, distance);
    RC_ASSERT(glm::length(apart) < 1e-8);
  }));
}

TEST(VolumeSpace, ARayAlongAFaceIsInsideAndOneBesideItIsNot) {
  for (const double tilt : {0.0, 1e-17, -1e-17}) {
    const auto on = insideUnitCube({{-1, 1, 0.5}, {1, tilt, 0}});
    ASSERT_TRUE(on);
    EXPECT_EQ(on->from, 1);
    EXPECT_EQ(on->to, 2);
    EXPECT_FALSE(insideUnitCube({{-1, 1.001, 0.5}, {1, tilt, 0}}));
    EXPECT_FALSE(insideUnitCube({{-1, -0.001, 0.5}, {1, tilt, 0}}));
  }
  EXPECT_FALSE(insideUnitCube({{-1, 1.5, 0.5}, {1, 1, 0}}));
}

TEST(VolumeSpace, WhatIsFlatOrNotFiniteOrNotAffineIsRefused) {
  EXPECT_TRUE(spaceOf(glm::scale(glm::dmat4(1), {1e-3, 1e6, 1e-3})));
  EXPECT_TRUE(spaceOf(glm::scale(glm::dmat4(1), {-1, 1, 1})));
  EXPECT_FALSE(spaceOf(glm::scale(glm::dmat4(1), {0, 1, 1})));
  EXPECT_FALSE(spaceOf(glm::scale(glm::dmat4(1), {kInfinite, 1, 1})));
  glm::dmat4 sheared(1);
  sheared[1] = {1, 0, 0, 0};
  EXPECT_FALSE(spaceOf(sheared));
  sheared[1] = {1, 1e-3, 0, 0};
  EXPECT_TRUE(spaceOf(sheared));
  glm::dmat4 projective(1);
  projective[0].w = 0.1;
  EXPECT_FALSE(spaceOf(projective));
  EXPECT_TRUE(spaceOf(Aabb{{0, 0, 0}, {1, 1e-3, 1}}));
  EXPECT_FALSE(spaceOf(Aabb{{0, 0, 0}, {1, 0, 1}}));
  EXPECT_FALSE(spaceOf(Aabb{{0, 0, 0}, {1, -1, 1}}));
  EXPECT_FALSE(spaceOf(Aabb{{0, 0, 0}, {1, kInfinite, 1}}));
  EXPECT_FALSE(spaceOf(Aabb{{0, std::nan(""), 0}, {1, 1, 1}}));
}

TEST(ViewRay, APerspectiveRaysDepthsAreLongerOffTheAxis) {
  CameraView view;
  view.eye = {100, 20, -3};
  view.halfSize = {1, 0.75};
  view.near = 0.5;
  view.far = 40;
  const ViewRay corner = viewRayAt(view, {1, -1});
  EXPECT_NEAR(corner.metresPerDepth, std::sqrt(1 + 1 + 0.5625), 1e-12);
  EXPECT_NEAR(glm::length(corner.ray.direction), 1, 1e-12);
  const glm::dvec3 near = pointAt(corner.ray, corner.seen.from) - view.eye;
  EXPECT_NEAR(near.z, -0.5, 1e-12);
  EXPECT_NEAR(near.x, 0.5, 1e-12);
  EXPECT_NEAR(near.y, -0.375, 1e-12);
  EXPECT_NEAR(corner.seen.to, 40 * corner.metresPerDepth, 1e-12);
}

TEST(ViewRay, AnOrthographicRayMayBeginBehindItsOrigin) {
  CameraView view;
  view.perspective = false;
  view.halfSize = {8, 4};
  view.near = -20;
  view.far = 30;
  const ViewRay ray = viewRayAt(view, {0.5, 0.25});
  EXPECT_EQ(ray.ray.origin, glm::dvec3(4, 1, 0));
  EXPECT_EQ(ray.ray.direction, glm::dvec3(0, 0, -1));
  EXPECT_EQ(ray.seen.from, -20);
  EXPECT_EQ(ray.seen.to, 30);
}

} // namespace
} // namespace gnomon
