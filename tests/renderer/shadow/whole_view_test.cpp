// What a plan covers of the view: all of it, and with which depths.
#include <gtest/gtest.h>

#include "renderer/shadow/filter_kernel.h"
#include "tests/renderer/shadow/plan_lookup.h"

namespace gnomon {
namespace {

TEST(WholeView, M1_AllEightCornersOfTheFrustumLieInTheTile) {
  PlanInput input = simplePlan(1, 60);
  Shadow& shadow = input.casters[0].shadow;
  shadow.cascadeCount = 1;
  shadow.depthRange = {DepthRangeMode::manual, 0, 60};
  for (const Stabilization mode : {Stabilization::none, Stabilization::projectionSnapping}) {
    shadow.stabilization = mode;
    // The survey's spans reach from 1 to 60 m everywhere, so that the surfaces fill the frustum.
    const ShadowPlan plan = planShadows(input);
    ASSERT_EQ(plan.tiles.size(), 1u);
    for (const double depth : {1.0, 60.0}) {
      for (const glm::dvec2 corner : {glm::dvec2(-1, -1), glm::dvec2(1, -1), glm::dvec2(-1, 1), glm::dvec2(1, 1)}) {
        EXPECT_TRUE(isServed(plan.tiles[0], pointAt(input.view, corner, depth)));
      }
    }
  }
}

TEST(WholeView, D3_ThreeCascadesCutTheViewIntoThreePartsEachWithATileOfItsOwn) {
  PlanInput input = simplePlan(1, 100);
  Shadow& shadow = input.casters[0].shadow;
  shadow.cascadeCount = 3;
  shadow.blendCascades = false;
  const ShadowPlan plan = planShadows(input);
  ASSERT_EQ(plan.tiles.size(), 3u);
  EXPECT_LE(plan.tiles[0].near, 1.0);
  EXPECT_GE(plan.tiles[2].far, 100.0);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(plan.tiles[i].rect.width, 1024);
    if (i > 0) {
      EXPECT_EQ(plan.tiles[i].near, plan.tiles[i - 1].far);
    }
  }
  for (double depth = 1; depth <= 100; depth += 0.5) {
    const auto tiles = tilesRead(plan, plan.lights[0], depth);
    ASSERT_EQ(tiles.size(), 1u) << depth;
    EXPECT_TRUE(isServed(*tiles[0], pointAt(input.view, {0.7, -0.7}, depth))) << depth;
  }
}

TEST(WholeView, M9_TheBiasIsALengthInTheWorldHoweverDeepTheMap) {
  // The article's bias is a share of the map's depth: 1 % of it, hence 13 cm of 13 m and a metre of 100 m.
  for (const double extent : {1.0, 13.0, 100.0, 1000.0}) {
    const double metres = depthBias(100, extent) * extent;
    EXPECT_LT(metres, 0.0003) << extent;
    EXPECT_GE(metres, depthRounding(100)) << extent;
  }
  EXPECT_DOUBLE_EQ(normalOffset(3, {0.1, 0.1}), 10 * normalOffset(3, {0.01, 0.01})) << "it follows the texel's size";
}

TEST(WholeView, G1_ALightWithoutARangeReachesTheFarthestSurfaceInView) {
  for (const float farthest : {20.0f, 5000.0f}) {
    PlanInput input = simplePlan(10, farthest);
    input.casters[0].type = LightType::point; // at the eye
    input.casters[0].range = 0;
    const ShadowPlan plan = planShadows(input);
    double reach = 0;
    for (const ShadowTile& tile : plan.tiles) reach = std::max(reach, tile.rect.width > 0 ? tile.far : 0.0);
    EXPECT_GE(reach, farthest);
    EXPECT_LT(reach, 1.2 * farthest);
  }
}

} // namespace
} // namespace gnomon
