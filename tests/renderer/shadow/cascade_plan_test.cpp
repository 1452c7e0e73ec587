// Ranges, splits, blend zones and stabilization of a planned light's cascades.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "renderer/shadow/shadow_plan.h"
#include "tests/renderer/shadow/plan_lookup.h"

namespace gnomon {
namespace {

using ::testing::HasSubstr;

TEST(CascadePlan, M13_CascadesMeetExactlyAtTheSplitDistances) {
  PlanInput input = simplePlan(1, 50);
  input.view.near = 0.5;
  Shadow& shadow = input.casters[0].shadow;
  shadow.cascadeCount = 3;
  shadow.blendCascades = false;
  shadow.partition = {PartitionMode::manual, 0.5, {0.2, 0.5, 1}};
  shadow.depthRange = {DepthRangeMode::manual, 0, 9.5};
  const ShadowPlan plan = planShadows(input);
  ASSERT_EQ(plan.tiles.size(), 3u);
  EXPECT_DOUBLE_EQ(plan.tiles[0].far, 2.4); // view depth, not clip z: 2.78 would be wrong
  EXPECT_DOUBLE_EQ(plan.tiles[1].near, 2.4);
  EXPECT_DOUBLE_EQ(plan.tiles[1].far, 5.25);
  EXPECT_EQ(tilesRead(plan, plan.lights[0], 2.4).front(), &plan.tiles[0]);
  EXPECT_EQ(tilesRead(plan, plan.lights[0], 2.4001).front(), &plan.tiles[1]);
}

TEST(CascadePlan, X22_BlendZonesLieInsideBothCascadesFitsFarFromTheEye) {
  PlanInput input = simplePlan(1, 60);
  input.view.near = 0.1;
  Shadow& shadow = input.casters[0].shadow;
  shadow.partition = {PartitionMode::manual, 0.5, {0.05, 0.15, 0.5, 1}};
  shadow.depthRange = {DepthRangeMode::manual, 19.9, 49.9};
  for (const Stabilization mode : {Stabilization::none, Stabilization::projectionSnapping}) {
    shadow.stabilization = mode;
    const ShadowPlan plan = planShadows(input);
    for (std::size_t i = 0; i + 1 < 4; ++i) {
      const ShadowTile& tile = plan.tiles[i];
      const ShadowTile& next = plan.tiles[i + 1];
      EXPECT_EQ(next.near, tile.blendNear);
      for (const double depth : {tile.blendNear, 0.5 * (tile.blendNear + tile.far), tile.far}) {
        for (const glm::dvec2 ndc : {glm::dvec2(-1, -1), glm::dvec2(1, -1), glm::dvec2(-1, 1), glm::dvec2(1, 1)}) {
          EXPECT_TRUE(isServed(tile, pointAt(input.view, ndc, depth)));
          EXPECT_TRUE(isServed(next, pointAt(input.view, ndc, depth)));
        }
      }
    }
  }
}

TEST(CascadePlan, X21_X23_AManualRangeStartsAtTheNearPlaneAndFadesOut) {
  PlanInput input = simplePlan(1, 90);
  input.view.near = 0.5;
  input.casters[0].shadow.depthRange = {DepthRangeMode::manual, 1, 21};
  const ShadowPlan plan = planShadows(input);
  EXPECT_TRUE(plan.lights[0].fadeOut);
  EXPECT_DOUBLE_EQ(plan.tiles.front().near, 1.5);
  EXPECT_DOUBLE_EQ(plan.tiles.back().far, 21.5);
  const double last = 21.5 - plan.tiles[2].far;
  EXPECT_DOUBLE_EQ(plan.tiles.back().blendNear, 21.5 - 0.2 * last);
  EXPECT_TRUE(tilesRead(plan, plan.lights[0], 22).empty());
}

TEST(CascadePlan, X23_AnAutomaticRangeHasNoFadeAndItsFarthestSurfaceIsServed) {
  const ShadowPlan plan = planShadows(simplePlan(1, 90));
  EXPECT_FALSE(plan.lights[0].fadeOut);
  EXPECT_EQ(plan.tiles.back().blendNear, plan.tiles.back().far);
  EXPECT_FALSE(tilesRead(plan, plan.lights[0], 90).empty());
}

TEST(CascadePlan, X16_X23_SplitsThatEndBeforeTheRangeFadeOut) {
  PlanInput input = simplePlan(1, 90);
  input.casters[0].shadow.cascadeCount = 1;
  input.casters[0].shadow.partition = {PartitionMode::manual, 0.5, {0.5}};
  const ShadowPlan plan = planShadows(input);
  EXPECT_TRUE(plan.lights[0].fadeOut);
  EXPECT_LT(plan.tiles[0].blendNear, plan.tiles[0].far);
  EXPECT_TRUE(tilesRead(plan, plan.lights[0], 80).empty());
}

TEST(CascadePlan, X24_StabilizationIsIgnoredInAnAutomaticRangeAndTheNoteSaysSo) {
  PlanInput input = simplePlan(1, 50);
  const ShadowPlan tight = planShadows(input);
  input.casters[0].shadow.stabilization = Stabilization::projectionSnapping;
  const ShadowPlan plan = planShadows(input);
  EXPECT_THAT(plan.lights[0].note, HasSubstr("stabilization is ignored"));
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(plan.tiles[i].clipFromRelative, tight.tiles[i].clipFromRelative);
  }
}

TEST(CascadePlan, X24_X20_WithAPreviousRangeStabilizationIsHonoured) {
  PlanInput input = simplePlan(1, 50);
  Shadow& shadow = input.casters[0].shadow;
  const auto base = planShadows(input).lights[0].depthRange;
  ASSERT_TRUE(base);
  shadow.depthRange.previous = PreviousRange{base->near, base->far};
  shadow.stabilization = Stabilization::projectionSnapping;
  const ShadowPlan first = planShadows(input);
  EXPECT_EQ(first.lights[0].note, "");
  PlanInput next = input;
  for (DepthSpan& block : next.receivers.blocks) block.farthest = std::max(block.nearest, block.farthest - 0.7f);
  next.receivers.range.farthest -= 0.7f;
  next.view.eye += glm::dvec3(0.3, 0.1, 0);
  const ShadowPlan second = planShadows(next);
  ASSERT_EQ(second.tiles.size(), first.tiles.size());
  for (std::size_t i = 0; i < first.tiles.size(); ++i) {
    EXPECT_EQ(second.tiles[i].far, first.tiles[i].far);
    EXPECT_EQ(second.tiles[i].space.fit.texelSize, first.tiles[i].space.fit.texelSize) << i;
  }
}

} // namespace
} // namespace gnomon
