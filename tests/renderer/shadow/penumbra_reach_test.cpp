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

TEST(PenumbraReach, NoCasterInAPyramidIsNearerThanTheNearest) {
  EXPECT_TRUE(rc::check([](unsigned seed) {
    Dice dice(seed);
    const RandomReach random = randomReach(dice);
    const double size = glm::length(random.scene.max - random.scene.min);
    const glm::dvec3 light = random.scene.center() + dice.direction() * (size * dice.between(0, 2));
    const glm::dmat4 toLight = lightFromRelative(random.basis, light);
    const glm::dvec2 low(dice.between(-2, 0.5), dice.between(-2, 0.5));
    const glm::dvec2 high = low + glm::dvec2(dice.between(0.1, 2), dice.between(0.1, 2));
    const auto nearest = nearestInPyramid(random.scene, toLight, low, high);
    for (int i = 0; i < 500; ++i) {
      const glm::dvec3 at(toLight * glm::dvec4(pointIn(dice, random.scene), 1.0));
      const glm::dvec2 tangents = glm::dvec2(at) / at.z;
      const bool in =
          at.z > 0 && tangents.x > low.x && tangents.y > low.y && tangents.x < high.x && tangents.y < high.y;
      if (!in) continue;
      RC_ASSERT(nearest.has_value());
      RC_ASSERT(at.z >= *nearest - 1e-9 * size);
    }
  }));
}

// Of a disc across the tile's direction, as pcss takes the light.
TEST(PenumbraReach, N1_WhatStandsBeforeAnyPartOfALampIsWithinIt) {
  EXPECT_TRUE(rc::check([](unsigned seed) {
    Dice dice(seed);
    const double lightRadius = std::pow(10, dice.between(-3, 0));
    const LightBasis basis = lightBasis(randomLightDirection(dice));
    const Aabb scene = randomBox(dice, 10);
    const glm::dmat4 toLight = lightFromRelative(basis, dice.direction() * dice.between(0, 30));
    Aabb seen = randomBox(dice, 1); // tangents
    seen.min.z = dice.between(0.1, 20);
    seen.max.z = seen.min.z * dice.between(1, 5);
    const double nearest = nearestCasterInPyramid(seen, scene, toLight, lightRadius, kWidestTangent);
    for (int i = 0; i < 300; ++i) {
      const glm::dvec3 receiver = pointIn(dice, seen);
      const glm::dvec3 caster(toLight * glm::dvec4(pointIn(dice, scene), 1.0));
      if (!(caster.z > 0 && caster.z < receiver.z)) continue;
      const double aside = glm::length(glm::dvec2(caster) / caster.z - glm::dvec2(receiver));
      const double hides = std::min(penumbraTangent(caster.z, receiver.z, lightRadius), kWidestTangent);
      if (aside <= hides) RC_ASSERT(caster.z >= nearest - 1e-9);
    }
  }));
}

TEST(PenumbraReach, WhatStandsBesideALampsPyramidDoesNotCount) {
  // A lamp 4 m over a wide floor of slabs 3 m high: seen to 45 degrees off its axis, what it shines past is 1 m away,
  // though a slab beside it is as near along a slanted axis as anything may be.
  const LightBasis slanted = lightBasis(glm::normalize(glm::dvec3(1, -1, 0)));
  const Aabb scene{glm::dvec3(-50, 0, -50), glm::dvec3(50, 3, 50)};
  const glm::dmat4 toLight = lightFromRelative(slanted, {0, 4, 0});
  EXPECT_LT(transformed(toLight, scene).min.z, 0) << "behind the lamp";
  const Aabb seen{glm::dvec3(-0.5, -0.5, 2), glm::dvec3(0.5, 0.5, 20)};
  EXPECT_GT(nearestCasterInPyramid(seen, scene, toLight, 0.01, kWidestTangent), 0.9);
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
