#include "renderer/bake/bake_light_map.h"

#include <gtest/gtest.h>

#include "renderer/core/parallel.h"
#include "tests/renderer/bake/share_at.h"
#include "tests/renderer/rays/shapes.h"

namespace gnomon {
namespace {

using testing::GlbBuilder;
using testing::Traced;

/// A square and a sphere over a floor.
Traced scene(const Light& light) {
  GlbBuilder builder;
  testing::addSquare(builder, 4, 0);
  testing::addSquare(builder, 1, 1);
  testing::addSphere(builder, {2, 1, 1.5}, 0.8, 24);
  Traced traced(builder);
  traced.lights = {light};
  return traced;
}

LightMapLayout layoutOf(const Traced& traced, double texelsPerMetre) {
  return *lightMapLayout(traced.scene.scene(), traced.scene.view(), {texelsPerMetre, {}});
}

TEST(BakeLightMap, WhatNothingHidesIsLitAndWhatASquareHidesIsDark) {
  const Traced traced = scene(testing::sunAlong({0, -1, 0}));
  const LightMapLayout layout = layoutOf(traced, 16);
  const auto map = bakeLightMap(traced.input(), 0, layout, 1, {});
  ASSERT_TRUE(map.has_value());
  const auto shareOn = [&](std::uint32_t instance, const glm::dvec2& weights) {
    const FlatTriangle t = layout.flat({instance, 0});
    return testing::shareAt(*map, glm::vec2(t[0] + weights.x * (t[1] - t[0]) + weights.y * (t[2] - t[0])));
  };
  EXPECT_EQ(shareOn(0, {0.02, 0.49}), 0) << "the middle of the floor, under the square";
  EXPECT_EQ(shareOn(0, {0.05, 0.05}), 1);
  EXPECT_EQ(shareOn(1, {0.3, 0.3}), 1) << "the square's lit side, whichever way it is turned";
}

TEST(BakeLightMap, IsTheSameOnAnyNumberOfCoresAndStopsWhenAsked) {
  const Traced traced = scene(testing::sunAlong({0.4, -1, 0.2}, 2));
  const LightMapLayout layout = layoutOf(traced, 12);
  std::vector<double> told;
  const auto map = bakeLightMap(traced.input(), 0, layout, 64, [&](double share) {
    told.push_back(share);
    return true;
  });
  ASSERT_TRUE(map.has_value());
  EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
  ASSERT_FALSE(told.empty());
  EXPECT_EQ(told.back(), 1);
  EXPECT_EQ(bakeLightMap(traced.input(), 0, layout, 64, {})->shares, map->shares);
  EXPECT_FALSE(bakeLightMap(traced.input(), 0, layout, 64, [](double) { return false; }).has_value());
}

TEST(BakeLightMap, BothWaysToReadItSayTheSame) {
  LightMap map{5, 4, {}};
  for (int i = 0; i < 20; ++i) map.shares.push_back(static_cast<std::uint16_t>(i * 9973 % 65536));
  for (float x = 0.5f; x <= 4.5f; x += 0.125f) {
    for (float y = 0.5f; y <= 3.5f; y += 0.125f) {
      EXPECT_NEAR(scaledShareAt(map, {x, y}), testing::shareAt(map, {x, y}) * 65535, 0.1) << x << " " << y;
    }
  }
  for (const glm::vec2& beyond : {glm::vec2(-3, -3), glm::vec2(0), glm::vec2(9, 9), glm::vec2(-1, 9)}) {
    EXPECT_GE(scaledShareAt(map, beyond), 0);
    EXPECT_LE(scaledShareAt(map, beyond), 65535);
  }
}

} // namespace
} // namespace gnomon
