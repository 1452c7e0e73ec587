#include "renderer/shadow/tile_size.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "protocol/spec/frame_lights.h"
#include "tests/renderer/shadow/random_plan.h"

namespace gnomon {
namespace {

constexpr std::array kSizes{ShadowSize::XLarge, ShadowSize::Large, ShadowSize::Medium, ShadowSize::Small,
                            ShadowSize::XSmall};

constexpr ShadowImportance kHigh = ShadowImportance::high;

TEST(TileSize, X2_X3_X4_FiveSizesByFiveViewports) {
  struct Row {
    int width, height;
    std::array<int, 5> sides; // XLarge .. XSmall
  };
  const std::array<Row, 5> rows{{{320, 240, {1024, 512, 256, 128, 64}},
                                 {512, 300, {1024, 512, 256, 128, 64}},
                                 {513, 300, {2048, 1024, 512, 256, 128}},
                                 {1280, 720, {2048, 1024, 512, 256, 128}},
                                 {1080, 4096, {2048, 1024, 512, 256, 128}}}};
  for (const Row& row : rows) {
    for (std::size_t i = 0; i < kSizes.size(); ++i) {
      EXPECT_EQ(askedTileSize(kSizes[i], kHigh, 1024, std::max(row.width, row.height)), row.sides[i])
          << row.width << ' ' << i;
    }
  }
}

TEST(TileSize, X5_EachStepOfImportanceHalves) {
  EXPECT_EQ(askedTileSize(ShadowSize::Large, ShadowImportance::high, 1024, 1280), 1024);
  EXPECT_EQ(askedTileSize(ShadowSize::Large, ShadowImportance::medium, 1024, 1280), 512);
  EXPECT_EQ(askedTileSize(ShadowSize::Large, ShadowImportance::low, 1024, 1280), 256);
  EXPECT_EQ(askedTileSize(ShadowSize::XSmall, ShadowImportance::low, 1024, 100), 4);
  EXPECT_EQ(askedTileSize(ShadowSize::XSmall, ShadowImportance::low, 1024, 3), 1);
}

TEST(TileSize, X4_WhatCoversNoPixelAsksForNothing) {
  for (const ShadowSize size : kSizes) EXPECT_EQ(askedTileSize(size, kHigh, 1024, 0), 0);
}

TEST(TileSize, X4_IsThePowerOfTwoOverTheScaledFrameForEverySide) {
  for (int side = 1; side <= 8192; ++side) {
    for (std::size_t i = 0; i < kSizes.size(); ++i) {
      const double factor = std::ldexp(2.0, -static_cast<int>(i));
      double power = 1.0 / 1024;
      while (power < side * factor) power *= 2;
      const double expected = std::max(1.0, std::min(2048 * factor, power));
      ASSERT_EQ(askedTileSize(kSizes[i], kHigh, 2048, side), static_cast<int>(expected)) << side << ' ' << i;
    }
  }
}

ShadowCaster point(const glm::dvec3& position, double range) {
  ShadowCaster light;
  light.type = LightType::point;
  light.position = position;
  light.range = range;
  return light;
}

ShadowCaster spot(const glm::dvec3& position, const glm::dvec3& direction, double range, double degrees) {
  ShadowCaster light = point(position, range);
  light.type = LightType::spot;
  light.direction = glm::normalize(direction);
  light.outerCone = glm::radians(degrees);
  return light;
}

int sizeOf(const ShadowCaster& light, const CameraView& view = {}) {
  return lightSize(light, view, 1600, 1600); // the default view: 90 degrees by 90, along -Z
}

TEST(LightCoverage, X7_APointLightCoversItsSpheresPicture) {
  // The silhouette of a sphere of 3 m, 5 m ahead, lies at asin(3 / 5): a tangent of 3 / 4 to each side.
  EXPECT_EQ(sizeOf(point({0, 0, -5}, 3)), 1200);
  EXPECT_EQ(sizeOf(point({0, 0, -2}, 3)), 1600) << "the camera is inside";
  EXPECT_EQ(sizeOf(point({0, 0, -3.1}, 3)), 1600) << "no more than the picture";
  EXPECT_EQ(sizeOf(point({0, 0, 5}, 3)), 0) << "behind";
  EXPECT_EQ(sizeOf(point({-20, 0, -5}, 3)), 0) << "beside";
  EXPECT_EQ(sizeOf(point({-6, 0, -5}, 3)), 1600) << "half in view, beside the camera, close to its plane";
  EXPECT_EQ(sizeOf(point({0, 0, -5}, 0)), 1600) << "without an end";
}

TEST(LightCoverage, X7_AnOrthographicCameraSeesTheSpheresOwnSize) {
  CameraView view;
  view.perspective = false;
  view.halfSize = {8, 8};
  view.near = 0;
  view.far = 100;
  for (const double depth : {10.0, 50.0}) EXPECT_EQ(sizeOf(point({0, 0, -depth}, 2), view), 400);
  EXPECT_EQ(sizeOf(point({20, 0, -10}, 2), view), 0);
}

TEST(LightCoverage, X6_ASpotCoversNoMoreThanItsCone) {
  EXPECT_LT(sizeOf(spot({0, 0, -20}, {1, 0, 0}, 4, 20)), sizeOf(point({0, 0, -20}, 4)));
  EXPECT_EQ(sizeOf(spot({0, 0, 5}, {0, 0, 1}, 3, 20)), 0) << "behind";
  EXPECT_EQ(sizeOf(spot({0, 0, 0}, {0, 0, -1}, 10, 30)), 1600) << "the camera at the apex";
  EXPECT_GT(sizeOf(spot({0, 0, 5}, {0, 0, -1}, 30, 20)), 0) << "behind, shining ahead";
  EXPECT_EQ(sizeOf(spot({0, 0, -5}, {0, 0, 1}, 30, 20)), 1600) << "the camera in the cone";
}

TEST(LightCoverage, X6_TheSphereOfASpotHoldsItsCone) {
  EXPECT_TRUE(rc::check([](unsigned seed) {
    Dice dice(seed);
    const ShadowCaster light =
        spot(dice.direction() * dice.between(0, 9), dice.direction(), dice.between(0.1, 9), dice.between(0.1, 89.9));
    const Sphere sphere = reachOf(light);
    RC_ASSERT(sphere.radius <= light.range * (1 + 1e-12));
    for (int i = 0; i < 100; ++i) {
      const glm::dvec3 away = dice.direction() * (light.range * dice.between(0, 1));
      if (glm::dot(away, light.direction) < std::cos(light.outerCone) * glm::length(away)) continue;
      RC_ASSERT(glm::length(light.position + away - sphere.center) <= sphere.radius * (1 + 1e-9));
    }
  }));
}

} // namespace
} // namespace gnomon
