#include "renderer/shadow/penumbra_reach.h"

#include <cmath>

#include "renderer/shadow/fit.h"
#include "tests/renderer/shadow/plan_lookup.h"

namespace gnomon {
namespace {

Aabb randomBox(Dice& dice, double size) {
  Aabb box;
  for (int i = 0; i < 2; ++i) box.add(glm::dvec3(dice.between(-1, 1), dice.between(-1, 1), dice.between(-1, 1)) * size);
  return box;
}

glm::dvec3 pointIn(Dice& dice, const Aabb& box) {
  return glm::mix(box.min, box.max, glm::dvec3(dice.between(0, 1), dice.between(0, 1), dice.between(0, 1)));
}

struct RandomReach {
  LightBasis basis;
  Aabb scene;
  Aabb receivers;
};

RandomReach randomReach(Dice& dice) {
  RandomReach random;
  random.basis = lightBasis(randomLightDirection(dice));
  random.scene = randomBox(dice, std::pow(10, dice.between(-1, 4)));
  random.receivers = randomBox(dice, std::pow(10, dice.between(-1, 4)));
  return random;
}

TEST(PenumbraReach, NoCasterOverARectangleIsNearerThanTheNearest) {
  EXPECT_TRUE(rc::check([](unsigned seed) {
    Dice dice(seed);
    const RandomReach random = randomReach(dice);
    const glm::dmat4 toLight = lightFromRelative(random.basis, {});
    const glm::dvec2 low(random.receivers.min);
    const glm::dvec2 high(random.receivers.max);
    const auto nearest = nearestOver(random.scene, toLight, low, high);
    const double slack = 1e-9 * glm::length(random.scene.max - random.scene.min);
    for (int i = 0; i < 500; ++i) {
      const glm::dvec3 at(toLight * glm::dvec4(pointIn(dice, random.scene), 1.0));
      const bool over = at.x > low.x && at.y > low.y && at.x < high.x && at.y < high.y;
      if (!over) continue;
      RC_ASSERT(nearest.has_value());
      RC_ASSERT(at.z >= *nearest - slack);
    }
  }));
}

TEST(PenumbraReach, OverAFlatSceneItIsTheSlantedWayThroughIt) {
  // A landscape of 1 km, 50 m high, and a sun 30 degrees up: 100 m of a ray lie within it.
  const LightBasis basis = lightBasis(glm::normalize(glm::dvec3(std::cos(glm::radians(30.0)), -0.5, 0)));
  const Aabb scene{glm::dvec3(-500, 0, -500), glm::dvec3(500, 50, 500)};
  const glm::dmat4 toLight = lightFromRelative(basis, {});
  const glm::dvec3 receiver(toLight * glm::dvec4(0, 0, 0, 1));
  const double radius = std::tan(glm::radians(0.265));
  const PenumbraReach reach = penumbraReach({receiver, receiver}, scene, toLight, radius);
  EXPECT_NEAR(receiver.z - reach.nearest, 100, 2);
  EXPECT_NEAR(reach.radius, radius * 100, 0.02);
}

// Light from any place of the disc reaches the receiver past the caster only within the reach.
TEST(PenumbraReach, N1_WhatStandsBeforeAnyPartOfTheLightIsWithinIt) {
  EXPECT_TRUE(rc::check([](unsigned seed) {
    Dice dice(seed);
    const RandomReach random = randomReach(dice);
    const glm::dmat4 toLight = lightFromRelative(random.basis, {});
    const double lightRadius = std::pow(10, dice.between(-3, 0));
    const PenumbraReach reach = penumbraReach(random.receivers, random.scene, toLight, lightRadius);
    for (int i = 0; i < 300; ++i) {
      const glm::dvec3 receiver = pointIn(dice, random.receivers);
      const glm::dvec3 caster(toLight * glm::dvec4(pointIn(dice, random.scene), 1.0));
      const double height = receiver.z - caster.z;
      const double aside = glm::length(glm::dvec2(caster) - glm::dvec2(receiver));
      if (!(height > 0) || aside > lightRadius * height) continue;
      const double slack = 1e-9 * (std::abs(height) + glm::length(random.receivers.max - random.receivers.min));
      RC_ASSERT(aside <= reach.radius + slack);
      RC_ASSERT(caster.z >= reach.nearest - slack);
    }
  }));
}

TEST(PenumbraReach, N1_OfALampItIsItsSizeAsTheCasterMakesItSeen) {
  // Lamp of 0.2 m, caster at 2 m, receiver at 3 m: half of 0.4 (3 - 2) / 2 metres, seen from 3 m.
  EXPECT_NEAR(penumbraTangent(2, 3, 0.2), 0.1 / 3, 1e-15);
  EXPECT_EQ(penumbraTangent(3, 3, 0.2), 0);
  EXPECT_EQ(penumbraTangent(4, 3, 0.2), 0) << "behind the receiver";
  EXPECT_EQ(penumbraTangent(-1, 3, 0), 0);
  EXPECT_GT(penumbraTangent(-1, 3, 0.2), 1e9) << "a caster may stand in the lamp";
}

TEST(PenumbraReach, N6_NoCasterOfATileIsClamped) {
  EXPECT_TRUE(rc::check([](const RandomPlan& random) {
    PlanInput input = random.input;
    for (ShadowCaster& caster : input.casters) {
      caster.shadow.filter = Filter{FilterType::pcss};
      caster.lightRadius = std::max(caster.lightRadius, 1e-3);
    }
    const ShadowPlan plan = planShadows(input);
    Dice dice(random.seed + 5);
    for (std::size_t l = 0; l < plan.lights.size(); ++l) {
      const PlannedLight& light = plan.lights[l];
      for (int i = 0; i < light.tileCount; ++i) {
        const ShadowTile& tile = plan.tiles[static_cast<std::size_t>(light.firstTile + i)];
        if (tile.rect.width == 0) continue;
        RC_ASSERT(tile.filter.kind == MapReadingKind::pcss);
        for (int k = 0; k < 50; ++k) {
          const ReceiverPoint point = randomReceiver(dice, input);
          if (point.depth < tile.near || point.depth > tile.far) continue;
          const glm::dvec3 at = tileCoordinates(tile, point.relative);
          const glm::dvec3 caster = tileCoordinates(tile, pointIn(dice, input.sceneBounds) - input.view.eye);
          const double height = (at.z - caster.z) * tile.space.fit.depthExtent;
          const double aside = glm::length(glm::dvec2(at - caster) * tile.space.fit.texelSize);
          if (!(height > 0) || aside > tile.filter.lightRadius * height) continue;
          RC_ASSERT(caster.z >= -1e-9);
          // A stable tile's size can't follow receivers far below the scene.
          if (input.casters[l].shadow.stabilization != Stabilization::none) continue;
          RC_ASSERT(caster.x >= 0 && caster.y >= 0 && caster.x <= tile.rect.width && caster.y <= tile.rect.width);
        }
      }
    }
  }));
}

} // namespace
} // namespace gnomon
