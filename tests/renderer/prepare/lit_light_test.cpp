#include "renderer/prepare/lit_light.h"

#include <gtest/gtest.h>

namespace gnomon {
namespace {

Light pointLight() {
  Light lamp;
  lamp.type = LightType::point;
  lamp.position = Vec3{1, 2, 3};
  return lamp;
}

TEST(LightData, OnlyPlannedLightsHaveTiles) {
  Light sun;
  sun.shadow = Shadow{};
  sun.shadow->strength = 0.5;
  sun.shadow->filter = {FilterType::hard, 5};
  ShadowPlan plan;
  plan.lights.push_back({.light = 1, .firstTile = 2, .tileCount = 3, .fadeOut = true, .note = ""});
  const std::vector<Light> lights{pointLight(), sun};
  const auto lit = litLights(lights, plan, {1, 1, 1});
  ASSERT_EQ(lit.size(), 2u);
  EXPECT_EQ(lit[0].tileCount, 0);
  EXPECT_EQ(lit[0].position, glm::dvec3(0, 1, 2));
  EXPECT_EQ(lit[0].range, 0.0) << "no range is infinite";
  EXPECT_EQ(lit[1].firstTile, 2);
  EXPECT_EQ(lit[1].tileCount, 3);
  EXPECT_EQ(lit[1].filter.size, 1) << "hard";
  EXPECT_EQ(lit[1].strength, 0.5);
  EXPECT_TRUE(lit[1].fadesOut);
  EXPECT_FALSE(lit[1].manualBias);
}

TEST(LightData, X14_LightsHoldTheGroupsThatTheyLight) {
  const std::vector<Light> lights(2);
  const std::vector<LitGroups> groups{{~0u, ~0u}, {5u, 4u}};
  const auto lit = litLights(lights, {}, {0, 0, 0}, groups);
  EXPECT_EQ(lit[0].groups, (LitGroups{~0u, ~0u}));
  EXPECT_EQ(lit[1].groups, (LitGroups{5u, 4u}));
  EXPECT_EQ(litLights(lights, {}, {0, 0, 0})[1].groups, (LitGroups{~0u, ~0u}));
}

TEST(LitLight, LayersAreCountedInTheirOwnOrder) {
  std::vector<Light> lights(3);
  for (Light& light : lights) light.shadow = Shadow{};
  lights[2].shadow->technique = ShadowTechnique::shadowVolume;
  lights[2].shadow->strength = 0.25;
  lights[0].shadow->technique = ShadowTechnique::rayTraced;
  const std::vector<int> layered{2, 0};
  const auto lit = litLights(lights, {}, {0, 0, 0}, {}, layered);
  EXPECT_EQ(lit[2].visibilityLayer, 0);
  EXPECT_EQ(lit[0].visibilityLayer, 1);
  EXPECT_EQ(lit[1].visibilityLayer, -1);
  EXPECT_EQ(lit[2].strength, 0.25);
  EXPECT_TRUE(lit[2].layerOmitsTurnedFaces) << "volumes don't know which faces are turned away";
  EXPECT_FALSE(lit[0].layerOmitsTurnedFaces) << "rays do";
  for (const LitLight& light : atFullStrength(lit)) EXPECT_EQ(light.strength, 1);
}

} // namespace
} // namespace gnomon
