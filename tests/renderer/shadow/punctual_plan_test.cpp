// Spot and point lights: what every plan for them must hold, whatever the view, the light and the surfaces.
#include <glm/gtc/constants.hpp>
#include <gtest/gtest.h>

#include "renderer/shadow/filter_kernel.h"
#include "renderer/shadow/light_draft.h"
#include "tests/renderer/shadow/plan_lookup.h"

namespace gnomon {
namespace {

/// A random frame whose lights stand somewhere about what the camera sees.
PlanInput punctualInput(const RandomPlan& random, Dice& dice) {
  PlanInput input = random.input;
  input.atlas.size = 8192;
  input.casters.clear();
  const int lights = 1 + dice.below(3);
  for (int i = 0; i < lights; ++i) {
    ShadowCaster caster{i, dice.direction(), randomShadow(dice)};
    caster.type = dice.chance(0.5) ? LightType::spot : LightType::point;
    caster.outerCone = glm::radians(dice.chance(0.3) ? dice.between(60, 89.9) : dice.between(1, 60));
    caster.position = randomReceiver(dice, input).relative + dice.direction() * dice.between(0.1, 100);
    caster.range = dice.chance(0.5) ? 0 : dice.between(1, 200);
    input.casters.push_back(caster);
  }
  return input;
}

double coneOf(const ShadowCaster& caster) {
  return caster.type == LightType::spot ? caster.outerCone : glm::pi<double>();
}

bool isLit(const ShadowCaster& caster, const glm::dvec3& relative) {
  const glm::dvec3 away = relative - caster.position;
  const double distance = glm::length(away);
  if (distance < 1e-6 || (caster.range > 0 && distance > caster.range)) return false;
  return caster.type == LightType::point ||
         glm::dot(away / distance, caster.direction) > std::cos(caster.outerCone) + 1e-9;
}

/// As the shader chooses it.
const ShadowTile& faceFor(const ShadowPlan& plan, const PlannedLight& light, const glm::dvec3& away) {
  const ShadowTile* best = nullptr;
  double most = -2 * glm::length(away);
  for (int i = 0; i < light.tileCount; ++i) {
    const ShadowTile& tile = plan.tiles[static_cast<std::size_t>(light.firstTile + i)];
    const double along = glm::dot(tile.space.basis.direction, away);
    if (along > most) {
      most = along;
      best = &tile;
    }
  }
  return *best;
}

glm::dvec3 clipOf(const ShadowTile& tile, const glm::dvec3& relative) {
  const glm::dvec4 clip = tile.clipFromRelative * glm::dvec4(relative, 1.0);
  return glm::dvec3(clip) / clip.w;
}

/// Calls `check(tile, caster, receiver)` for lit surface points beyond the part of a tile's range where depth is
/// clamped.
template <class Check>
void forLitReceivers(const RandomPlan& random, Check check) {
  RC_PRE(!random.input.receivers.range.empty());
  Dice dice(random.seed + 11);
  const PlanInput input = punctualInput(random, dice);
  const ShadowPlan plan = planShadows(input);
  for (int i = 0; i < 100; ++i) {
    const glm::dvec3 receiver = randomReceiver(dice, input).relative;
    for (std::size_t l = 0; l < input.casters.size(); ++l) {
      const ShadowCaster& caster = input.casters[l];
      if (!isLit(caster, receiver) || caster.shadow.strength <= 0) continue;
      RC_ASSERT(plan.lights[l].tileCount > 0 || plan.lights[l].grantedTileSize == 0);
      if (plan.lights[l].tileCount == 0) continue;
      const ShadowTile& tile = faceFor(plan, plan.lights[l], receiver - caster.position);
      check(dice, tile, caster, receiver);
    }
  }
}

TEST(PunctualPlan, X31_X32_EveryLitSurfaceHasTexelsAndRoomForItsFilter) {
  EXPECT_TRUE(rc::check([](const RandomPlan& random) {
    forLitReceivers(random, [](Dice& dice, const ShadowTile& tile, const ShadowCaster&, const glm::dvec3& receiver) {
      RC_ASSERT(tile.rect.width > 0);
      const glm::dvec4 clip = tile.clipFromRelative * glm::dvec4(receiver, 1.0);
      RC_ASSERT(clip.w > 0);
      if (tile.space.fit.normalOffset > 0.25) return; // a few texels for a wide cone: nothing to promise
      const glm::dvec3 moved = receiver + dice.direction() * (tile.space.fit.normalOffset * clip.w);
      const glm::dvec3 at = clipOf(tile, moved);
      const double inner = 1.0 - 2.0 * tile.border / tile.rect.width + 1e-6;
      RC_ASSERT(std::abs(at.x) <= inner && std::abs(at.y) <= inner && at.z <= 1.0 + 1e-9);
    });
  }));
}

TEST(PunctualPlan, M5_X26_WhateverStandsBetweenTheLightAndASurfaceMayCast) {
  EXPECT_TRUE(rc::check([](const RandomPlan& random) {
    forLitReceivers(random,
                    [](Dice& dice, const ShadowTile& tile, const ShadowCaster& caster, const glm::dvec3& receiver) {
                      const glm::dvec3 between = glm::mix(caster.position, receiver, dice.between(1e-3, 1));
                      Aabb box;
                      box.add(between);
                      box.add(between + dice.direction() * dice.between(0, 50));
                      RC_ASSERT(mayCastInto(tile, box));
                    });
  }));
}

TEST(PunctualPlan, H4_AMovedReceiverStandsClearOfItsOwnPlaneUnderTheWholeFilter) {
  EXPECT_TRUE(rc::check([](const RandomPlan& random) {
    forLitReceivers(random, [](Dice& dice, const ShadowTile& tile, const ShadowCaster& caster,
                               const glm::dvec3& receiver) {
      const Fit& fit = tile.space.fit;
      if (fit.normalOffset > 0.25) return;
      glm::dvec3 normal = dice.direction();
      const glm::dvec3 toLight = caster.position - receiver;
      if (glm::dot(normal, toLight) < 0) normal = -normal;
      const glm::dvec3 axis = tile.space.basis.direction;
      const double depth = glm::dot(axis, -toLight);
      const double sine = glm::length(glm::cross(normal, axis));
      const glm::dvec3 moved = receiver + normal * (fit.normalOffset * depth * sine);
      const double movedDepth = glm::dot(axis, moved - caster.position);
      const glm::dvec2 step = fit.texelSize * movedDepth * kBiasReach;
      const glm::dvec3 neighbour = moved - caster.position + tile.space.basis.right * (step.x * dice.between(-1, 1)) +
                                   tile.space.basis.up * (step.y * dice.between(-1, 1));
      // On the plane's lit side, so that the plane lies behind it, seen from the light.
      RC_ASSERT(glm::dot(normal, neighbour + caster.position - receiver) >= -1e-9 * (1 + depth));
    });
  }));
}

TEST(PunctualPlan, X32_TheFacesOfAPointLightShareOutAllDirections) {
  EXPECT_TRUE(rc::check([](unsigned seed) {
    Dice dice(seed);
    ShadowCaster light{0, dice.direction(), {}};
    light.type = dice.chance(0.5) ? LightType::spot : LightType::point;
    light.outerCone = glm::radians(dice.between(1, 89.9));
    const std::vector<LightFace> faces = facesOf(light);
    for (int i = 0; i < 100; ++i) {
      const glm::dvec3 away = dice.direction();
      if (glm::dot(away, light.direction) <= std::cos(coneOf(light))) continue;
      int within = 0;
      for (const LightFace& face : faces) {
        const glm::dvec3 ls = face.basis.lightFromWorld() * away;
        const double side = std::max(std::abs(ls.x), std::abs(ls.y));
        if (ls.z > 0 && side <= face.tanHalf * ls.z + 1e-12) ++within;
        RC_ASSERT(glm::length(glm::cross(face.basis.right, face.basis.up) + face.basis.direction) < 1e-9);
      }
      RC_ASSERT(within >= 1);
    }
  }));
}

TEST(PunctualPlan, X31_ASpotUpToSixtyDegreesTakesOneTileAWiderOneFacesOfACube) {
  ShadowCaster spot{0, {0, -1, 0}, {}};
  spot.type = LightType::spot;
  spot.outerCone = glm::radians(60.0);
  EXPECT_EQ(facesOf(spot).size(), 1u);
  spot.outerCone = glm::radians(60.1);
  EXPECT_EQ(facesOf(spot).size(), 5u);
  spot.outerCone = glm::radians(89.9);
  EXPECT_EQ(facesOf(spot).size(), 5u);
  spot.type = LightType::point;
  EXPECT_EQ(facesOf(spot).size(), 6u);
}

/// How slim the one tile of a spot at the eye is whose picture shows a strip from corner to corner.
double slimness(bool rising, Stabilization stabilization) {
  PlanInput input = simplePlan(10, 11);
  ReceiverDepths& seen = input.receivers;
  for (int row = 0; row < seen.rows; ++row) {
    for (int column = 0; column < seen.columns; ++column) {
      const bool shows = std::abs(column - (rising ? seen.rows - 1 - row : row)) <= 3;
      if (!shows) seen.blocks[static_cast<std::size_t>(row * seen.columns + column)] = {};
    }
  }
  ShadowCaster& spot = input.casters[0];
  spot.type = LightType::spot;
  spot.direction = input.view.forward;
  spot.outerCone = glm::radians(50.0);
  spot.shadow.stabilization = stabilization;
  const glm::dvec2 texel = planShadows(input).tiles.at(0).space.fit.texelSize;
  return std::min(texel.x, texel.y) / std::max(texel.x, texel.y);
}

TEST(PunctualPlan, ASpotsTileTurnsToWhatIsSeen) {
  for (const bool rising : {false, true}) {
    EXPECT_LT(slimness(rising, Stabilization::none), 0.25);
    EXPECT_NEAR(slimness(rising, Stabilization::viewSnapping), 1, 1e-9) << "a stabilized tile serves all of the cone";
  }
}

TEST(PunctualPlan, ALightThatReachesNothingInViewGetsNoTile) {
  PlanInput input = simplePlan(10, 20);
  input.casters[0].type = LightType::point;
  input.casters[0].position = {0, 0, 50}; // behind the camera
  input.casters[0].range = 30;
  const ShadowPlan plan = planShadows(input);
  EXPECT_EQ(plan.atlasWidth, 0);
  EXPECT_EQ(plan.lights[0].tileCount, 0);
  EXPECT_EQ(plan.lights[0].note, "what it reaches is out of view");
  input.casters[0].range = 0;
  EXPECT_GT(planShadows(input).atlasWidth, 0);
}

TEST(PunctualPlan, FacesThatNoSurfaceInViewLiesInAreNotDrawn) {
  PlanInput input = simplePlan(10, 20);
  input.casters[0].type = LightType::point; // at the eye: all that is in view lies ahead
  const ShadowPlan plan = planShadows(input);
  ASSERT_EQ(plan.lights[0].tileCount, 6);
  int drawn = 0;
  for (const ShadowTile& tile : plan.tiles) drawn += tile.rect.width > 0 ? 1 : 0;
  EXPECT_GE(drawn, 1);
  EXPECT_LT(drawn, 6);
}

} // namespace
} // namespace gnomon
