#include "renderer/shadow/tile_space.h"

#include <gtest/gtest.h>

#include "tests/renderer/shadow/plan_lookup.h"

namespace gnomon {
namespace {

Aabb box(const glm::dvec3& low, const glm::dvec3& high) {
  Aabb result;
  result.add(low);
  result.add(high);
  return result;
}

TEST(ReceiverMask, M14_OnlyWhatStandsOverAReceiverAndBeforeItMayShadow) {
  const ReceiverMask mask = receiverMask({box({-0.5, -0.5, 0.4}, {-0.25, -0.25, 0.6})}, {0.0, 0.0});
  EXPECT_TRUE(mask.mayShadow(box({-0.4, -0.4, 0.1}, {-0.3, -0.3, 0.2})));
  EXPECT_TRUE(mask.mayShadow(box({-0.4, -0.4, -50}, {-0.3, -0.3, -40}))) << "before the tile";
  EXPECT_TRUE(mask.mayShadow(box({-9, -9, 0.6}, {9, 9, 0.9}))) << "a part of it lies between";
  EXPECT_FALSE(mask.mayShadow(box({-0.4, -0.4, 0.61}, {-0.3, -0.3, 0.7}))) << "behind the farthest receiver";
  EXPECT_FALSE(mask.mayShadow(box({0.1, -0.4, 0.1}, {0.2, -0.3, 0.2}))) << "beside";
  EXPECT_FALSE(mask.mayShadow(box({-3, -3, 0.1}, {-2, -2, 0.2}))) << "outside of the tile";
}

TEST(ReceiverMask, ALookupBesideAReceiverCounts) {
  const std::vector<Aabb> receiver{box({0.0, 0.0, 0.5}, {0.01, 0.01, 0.5})};
  const Aabb caster = box({0.2, 0.0, 0.1}, {0.21, 0.01, 0.1});
  EXPECT_FALSE(receiverMask(receiver, {0.05, 0.05}).mayShadow(caster));
  EXPECT_TRUE(receiverMask(receiver, {0.2, 0.05}).mayShadow(caster));
}

TEST(ReceiverMask, ACellKeepsItsFarthestReceiver) {
  const ReceiverMask mask =
      receiverMask({box({0, 0, 0.2}, {0.01, 0.01, 0.8}), box({0, 0, 0.1}, {0.01, 0.01, 0.3})}, {});
  EXPECT_TRUE(mask.mayShadow(box({0, 0, 0.7}, {0.01, 0.01, 0.7})));
}

Aabb boxAround(const glm::dvec3& point, double half) {
  Aabb box;
  box.add(point - glm::dvec3(half));
  box.add(point + glm::dvec3(half));
  return box;
}

TEST(Casters, M5_X26_WhateverStandsBetweenAReceiverAndTheLightMayCast) {
  EXPECT_TRUE(rc::check([](const RandomPlan& random) {
    const ShadowPlan plan = planShadows(random.input);
    RC_PRE(!plan.tiles.empty());
    Dice dice(random.seed + 3);
    for (int i = 0; i < 200; ++i) {
      const ReceiverPoint receiver = randomReceiver(dice, random.input);
      for (std::size_t l = 0; l < plan.lights.size(); ++l) {
        const double distance = dice.chance(0.1) ? 0 : std::pow(10, dice.between(-2, 5));
        const glm::dvec3 caster = receiver.relative - random.input.casters[l].direction * distance;
        Aabb box; // one that has the caster on its surface, anywhere
        box.add(caster);
        box.add(caster + dice.direction() * dice.between(0, 100));
        for (const ShadowTile* tile : tilesRead(plan, plan.lights[l], receiver.depth)) {
          RC_ASSERT(mayCastInto(*tile, box));
        }
      }
    }
  }));
}

TEST(Casters, M14_WhatLiesBesideOrBehindCannotCast) {
  EXPECT_TRUE(rc::check([](const RandomPlan& random) {
    const ShadowPlan plan = planShadows(random.input);
    Dice dice(random.seed + 6);
    for (const PlannedLight& light : plan.lights) {
      for (int i = 0; i < light.tileCount; ++i) {
        const ShadowTile& tile = plan.tiles[static_cast<std::size_t>(light.firstTile + i)];
        if (tile.rect.width == 0) continue;
        const glm::dmat4 relativeFromClip = glm::inverse(tile.clipFromRelative);
        const auto mayCast = [&](double x, double y, double z) {
          Aabb point;
          point.add(glm::dvec3(relativeFromClip * glm::dvec4(x, y, z, 1)));
          return mayCastInto(tile, point);
        };
        // Over a cell where receivers look, whatever stands before them may; where none looks, nothing does.
        const std::size_t cell = static_cast<std::size_t>(dice.below(static_cast<int>(tile.receivers.farthest.size())));
        const float farthest = tile.receivers.farthest[cell];
        const double x = (static_cast<double>(cell % ReceiverMask::kSide) + 0.5) * 2 / ReceiverMask::kSide - 1;
        const double y = (static_cast<double>(cell / ReceiverMask::kSide) + 0.5) * 2 / ReceiverMask::kSide - 1;
        RC_ASSERT(mayCast(x, y, -100) == (farthest >= 0)); // before the tile: drawn with its depth clamped
        RC_ASSERT(mayCast(x, y, farthest - 1e-3) == (farthest >= 0));
        RC_ASSERT(!mayCast(x, y, std::max(farthest, 0.0f) + 1e-3));
        RC_ASSERT(!mayCast(1.01, 0, 0.5));
        RC_ASSERT(!mayCast(-1.01, 0, 0.5));
        RC_ASSERT(!mayCast(0, 1.01, 0.5));
        RC_ASSERT(!mayCast(0, -1.01, 0.5));
        RC_ASSERT(!mayCast(0, 0, 1.01));
      }
    }
  }));
}

TEST(Casters, M5_ACasterBehindTheCameraAndUpstreamCasts) {
  PlanInput input = simplePlan(1, 50); // looks along -Z
  input.casters[0].direction = glm::normalize(glm::dvec3(0, -1, -1));
  const ShadowPlan plan = planShadows(input);
  const Aabb caster = boxAround(glm::dvec3(0, 40, 20), 1); // its shadow lies on the axis, 20 m ahead
  bool casts = false;
  for (const ShadowTile& tile : plan.tiles) casts = casts || mayCastInto(tile, caster);
  EXPECT_TRUE(casts);
  for (const ShadowTile& tile : plan.tiles) EXPECT_FALSE(mayCastInto(tile, boxAround(glm::dvec3(0, 40, 400), 1)));
}

TEST(Casters, AnEmptyBoxAndATileWithoutTexelsHaveNoCasters) {
  const ShadowPlan plan = planShadows(simplePlan(1, 50));
  EXPECT_FALSE(mayCastInto(plan.tiles[0], Aabb{}));
  EXPECT_FALSE(mayCastInto(ShadowTile{}, boxAround(glm::dvec3(0), 1)));
}

} // namespace
} // namespace gnomon
