#include "renderer/shadow/shadow_plan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "renderer/shadow/filter_kernel.h"
#include "tests/renderer/shadow/plan_lookup.h"

namespace gnomon {
namespace {

using ::testing::HasSubstr;

bool drawn(const ShadowPlan& plan) {
  return std::any_of(plan.tiles.begin(), plan.tiles.end(), [](const ShadowTile& t) { return t.rect.width > 0; });
}

TEST(ShadowPlan, X22_M13_M17_EveryReceiverIsServedByEachTileThatItReads) {
  EXPECT_TRUE(rc::check([](const RandomPlan& random) {
    const ShadowPlan plan = planShadows(random.input);
    RC_PRE(drawn(plan));
    Dice dice(random.seed + 1);
    for (int i = 0; i < 200; ++i) {
      const ReceiverPoint point = randomReceiver(dice, random.input);
      for (const PlannedLight& light : plan.lights) {
        for (const ShadowTile* tile : tilesRead(plan, light, point.depth)) {
          RC_ASSERT(isServed(*tile, point.relative));
        }
      }
    }
  }));
}

TEST(ShadowPlan, X13_AFilterNeverReadsBesideItsTileNorThePointBeforeItsDepths) {
  EXPECT_TRUE(rc::check([](const RandomPlan& random) {
    const ShadowPlan plan = planShadows(random.input);
    RC_PRE(drawn(plan));
    Dice dice(random.seed + 2);
    for (int i = 0; i < 200; ++i) {
      const ReceiverPoint point = randomReceiver(dice, random.input);
      for (std::size_t l = 0; l < plan.lights.size(); ++l) {
        const double reach = kernelOf(random.input.casters[l].shadow.filter).reach;
        for (const ShadowTile* tile : tilesRead(plan, plan.lights[l], point.depth)) {
          const glm::dvec3 moved = point.relative + dice.direction() * tile->space.fit.normalOffset;
          const glm::dvec3 at = tileCoordinates(*tile, moved);
          RC_ASSERT(isServed(*tile, moved));
          for (int axis = 0; axis < 2; ++axis) {
            const double read = reach + tile->space.fit.radius / tile->space.fit.texelSize[axis];
            RC_ASSERT(at[axis] - read - 0.5 >= 0);
            RC_ASSERT(at[axis] + read + 0.5 <= tile->rect.width);
          }
          RC_ASSERT(at.z - tile->depthBias > 0);
        }
      }
    }
  }));
}

TEST(ShadowPlan, X9_X12_TilesNeverOverlapAndStayInsideTheAtlas) {
  EXPECT_TRUE(rc::check([](const RandomPlan& random) {
    const ShadowPlan plan = planShadows(random.input);
    RC_ASSERT(plan.atlasWidth <= random.input.atlas.size && plan.atlasHeight <= random.input.atlas.size);
    for (std::size_t i = 0; i < plan.tiles.size(); ++i) {
      const Rect& a = plan.tiles[i].rect;
      RC_ASSERT(a.x >= 0 && a.y >= 0 && a.x + a.width <= plan.atlasWidth && a.y + a.height <= plan.atlasHeight);
      for (std::size_t j = 0; j < i; ++j) {
        const Rect& b = plan.tiles[j].rect;
        RC_ASSERT(a.x + a.width <= b.x || b.x + b.width <= a.x || a.y + a.height <= b.y || b.y + b.height <= a.y);
      }
    }
  }));
}

TEST(ShadowPlan, X10_TheOrderOfTheLightsChangesNoTile) {
  EXPECT_TRUE(rc::check([](const RandomPlan& random) {
    const ShadowPlan plan = planShadows(random.input);
    PlanInput reversed = random.input;
    std::reverse(reversed.casters.begin(), reversed.casters.end());
    const ShadowPlan other = planShadows(reversed);
    RC_ASSERT(other.atlasWidth == plan.atlasWidth && other.atlasHeight == plan.atlasHeight);
    for (std::size_t l = 0; l < plan.lights.size(); ++l) {
      const PlannedLight& a = plan.lights[l];
      const PlannedLight& b = other.lights[plan.lights.size() - 1 - l];
      RC_ASSERT(a.light == b.light && a.tileCount == b.tileCount && a.note == b.note);
      for (int i = 0; i < a.tileCount; ++i) {
        const ShadowTile& x = plan.tiles[static_cast<std::size_t>(a.firstTile + i)];
        const ShadowTile& y = other.tiles[static_cast<std::size_t>(b.firstTile + i)];
        RC_ASSERT(x.rect == y.rect && x.clipFromRelative == y.clipFromRelative);
      }
    }
  }));
}

TEST(ShadowPlan, X11_EveryLightIsEitherAsAskedOrHasANote) {
  EXPECT_TRUE(rc::check([](const RandomPlan& random) {
    for (const PlannedLight& light : planShadows(random.input).lights) {
      RC_ASSERT(light.grantedTileSize == light.askedTileSize || !light.note.empty());
      RC_ASSERT((light.tileCount == 0) == (light.grantedTileSize == 0));
    }
  }));
}

TEST(ShadowPlan, X17_X18_G5_EverythingIsFiniteForAnyView) {
  EXPECT_TRUE(rc::check([](const RandomPlan& random) {
    for (const ShadowTile& tile : planShadows(random.input).tiles) {
      RC_ASSERT(std::isfinite(tile.near) && std::isfinite(tile.far) && tile.near < tile.far);
      RC_ASSERT(tile.blendNear > tile.near && tile.blendNear <= tile.far);
      for (int c = 0; c < 4; ++c) {
        for (int r = 0; r < 4; ++r) RC_ASSERT(std::isfinite(tile.clipFromRelative[c][r]));
      }
      if (tile.rect.width == 0) continue;
      RC_ASSERT(tile.space.fit.texelSize.x > 0 && tile.space.fit.texelSize.y > 0 &&
                std::isfinite(tile.space.fit.texelSize.x + tile.space.fit.texelSize.y));
      RC_ASSERT(tile.space.fit.depthExtent > 0 && std::isfinite(tile.space.fit.depthExtent));
      RC_ASSERT(tile.space.fit.normalOffset > 0 && tile.depthBias > 0 && tile.depthBias < 0.5);
    }
  }));
}

TEST(ShadowPlan, X18_NothingInViewNeedsNoTile) {
  PlanInput input = simplePlan(1, 2);
  input.receivers = ReceiverDepths{};
  const ShadowPlan plan = planShadows(input);
  EXPECT_EQ(plan.atlasWidth, 0);
  EXPECT_TRUE(plan.tiles.empty());
  ASSERT_EQ(plan.lights.size(), 1u);
  EXPECT_EQ(plan.lights[0].note, "nothing in view");
}

TEST(ShadowPlan, X18_APlaneThatFacesTheCameraIsServed) {
  for (const float depth : {0.01f, 5.0f, 1e6f}) {
    PlanInput input = simplePlan(depth, depth);
    input.view.near = 0.001;
    const ShadowPlan plan = planShadows(input);
    const auto tiles = tilesRead(plan, plan.lights[0], depth);
    ASSERT_FALSE(tiles.empty());
    for (const ShadowTile* tile : tiles) EXPECT_TRUE(isServed(*tile, pointAt(input.view, {0.9, -0.9}, depth)));
  }
}

TEST(ShadowPlan, X1_ASwitchedOffShadowGetsNoTileAndSaysSo) {
  PlanInput input = simplePlan(1, 50);
  input.casters.push_back({1, {0, -1, 0}, {}});
  input.casters[0].shadow.enabled = false;
  input.casters[1].shadow.strength = 0;
  const ShadowPlan plan = planShadows(input);
  EXPECT_TRUE(plan.tiles.empty());
  for (const PlannedLight& light : plan.lights) {
    EXPECT_EQ(light.askedTileSize, 0);
    EXPECT_FALSE(light.note.empty());
  }
}

TEST(ShadowPlan, AScenesWithoutCastersNeedsNoTile) {
  PlanInput input = simplePlan(1, 50);
  input.sceneBounds = {};
  EXPECT_TRUE(planShadows(input).tiles.empty());
  EXPECT_THAT(planShadows(input).lights[0].note, HasSubstr("casts"));
}

TEST(ShadowPlan, D1_EveryLightCasts) {
  PlanInput input = simplePlan(1, 50);
  input.casters.push_back({5, {0, -1, 0}, {}});
  const ShadowPlan plan = planShadows(input);
  ASSERT_EQ(plan.lights.size(), 2u);
  EXPECT_EQ(plan.lights[0].tileCount, 4);
  EXPECT_EQ(plan.lights[1].light, 5);
  EXPECT_EQ(plan.lights[1].firstTile, 4);
  EXPECT_EQ(plan.lights[1].tileCount, 4);
  EXPECT_EQ(plan.atlasWidth * plan.atlasHeight, 8 * 1024 * 1024);
}

TEST(ShadowPlan, X18_ACascadeWithoutASurfaceIsNotDrawn) {
  PlanInput input = simplePlan(1, 50);
  for (std::size_t i = 0; i < input.receivers.blocks.size(); ++i) {
    input.receivers.blocks[i] = i < 3200 ? DepthSpan{1, 1.1f} : DepthSpan{49, 50};
  }
  input.casters[0].shadow.partition.mode = PartitionMode::uniform;
  const ShadowPlan plan = planShadows(input);
  ASSERT_EQ(plan.lights[0].tileCount, 4);
  EXPECT_EQ(plan.tiles[0].rect.width, 1024);
  EXPECT_EQ(plan.tiles[1].rect.width, 0);
  EXPECT_EQ(plan.tiles[2].rect.width, 0);
  EXPECT_EQ(plan.tiles[3].rect.width, 1024);
  EXPECT_EQ(plan.atlasWidth, 2048);
  EXPECT_EQ(plan.atlasHeight, 1024);
  EXPECT_THAT(plan.lights[0].note, HasSubstr("1, 2"));
}

TEST(ShadowPlan, X11_DemotionsAndRefusalsAreNoted) {
  PlanInput input = simplePlan(1, 50);
  input.atlas.size = 128;
  input.atlas.baseSize = 128;
  input.casters.push_back({1, {0, -1, 0}, {}});
  const ShadowPlan plan = planShadows(input);
  EXPECT_EQ(plan.lights[0].askedTileSize, 128);
  EXPECT_EQ(plan.lights[0].grantedTileSize, 64);
  EXPECT_THAT(plan.lights[0].note, HasSubstr("64 x 64 texels instead of 128 x 128"));
  EXPECT_EQ(plan.lights[1].tileCount, 0);
  EXPECT_THAT(plan.lights[1].note, HasSubstr("no room"));
}

TEST(ShadowPlan, X8_TheDevicesLimitBoundsTheAtlas) {
  PlanInput input = simplePlan(1, 50);
  input.maxTextureSize = 1024;
  const ShadowPlan plan = planShadows(input);
  EXPECT_EQ(plan.atlasWidth, 1024);
  EXPECT_EQ(plan.lights[0].grantedTileSize, 512);
}

TEST(ShadowPlan, X4_ATileSmallerThanItsFilterIsRaisedAndNoted) {
  PlanInput input = simplePlan(1, 50);
  input.atlas.baseSize = 128;
  input.casters[0].shadow.size = ShadowSize::XSmall;
  const ShadowPlan plan = planShadows(input);
  EXPECT_EQ(plan.lights[0].askedTileSize, 16);
  EXPECT_EQ(plan.lights[0].grantedTileSize, 64);
  EXPECT_THAT(plan.lights[0].note, HasSubstr("smallest"));
}

TEST(ShadowPlan, M4_ReceiversUseTheWholeDepthOfTheirTile) {
  PlanInput input = simplePlan(10, 50);
  input.casters[0].shadow.cascadeCount = 1;
  const ShadowPlan plan = planShadows(input);
  double least = 1;
  double greatest = 0;
  for (const double depth : {10.0, 50.0}) {
    for (const glm::dvec2 ndc : {glm::dvec2(-1, -1), glm::dvec2(1, -1), glm::dvec2(-1, 1), glm::dvec2(1, 1)}) {
      const double z = tileCoordinates(plan.tiles[0], pointAt(input.view, ndc, depth)).z;
      least = std::min(least, z);
      greatest = std::max(greatest, z);
    }
  }
  EXPECT_LT(least, 0.01);
  EXPECT_GT(greatest, 0.99);
}

TEST(ShadowPlan, M2_DepthGrowsWhereTheLightTravels) {
  const PlanInput input = simplePlan(10, 50);
  const ShadowPlan plan = planShadows(input);
  const glm::dvec3 point = pointAt(input.view, {0, 0}, 30);
  const glm::dvec3 upstream = tileCoordinates(plan.tiles[3], point - input.casters[0].direction);
  const glm::dvec3 downstream = tileCoordinates(plan.tiles[3], point + input.casters[0].direction);
  EXPECT_NEAR(upstream.x, downstream.x, 1e-9);
  EXPECT_NEAR(upstream.y, downstream.y, 1e-9);
  EXPECT_NEAR((downstream.z - upstream.z) * plan.tiles[3].space.fit.depthExtent, 2.0, 1e-9);
}

TEST(ShadowPlan, X15_AnOrthographicCameraGetsItsCascades) {
  PlanInput input = simplePlan(0, 40);
  input.view.perspective = false;
  input.view.halfSize = {10, 10};
  input.view.near = -50;
  input.view.far = 100;
  for (const float nearest : {0.0f, -45.0f}) {
    input.receivers.range.nearest = nearest;
    input.receivers.blocks.assign(6400, input.receivers.range);
    const ShadowPlan plan = planShadows(input);
    ASSERT_EQ(plan.tiles.size(), 4u);
    for (const ShadowTile& tile : plan.tiles) EXPECT_GT(tile.rect.width, 0);
  }
}

} // namespace
} // namespace gnomon
