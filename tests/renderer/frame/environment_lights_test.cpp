#include "renderer/frame/environment_lights.h"

#include <cmath>
#include <gtest/gtest.h>

#include "renderer/core/light.h"
#include "renderer/frame/settle_frame.h"
#include "tests/renderer/frame/squares.h"
#include "tests/renderer/made_environment.h"

namespace gnomon {
namespace {

const glm::dvec3 kTowards = glm::normalize(glm::dvec3(1, 1, 0.02));

/// Squares, and an environment whose sun stands over +X.
ScenePtr lit() {
  auto scene = std::make_shared<Scene>(*testing::squares());
  scene->environmentFiles.emplace(
      "sun.hdr", std::make_shared<const EnvironmentFile>(testing::hdrFile(128, [](const glm::dvec3& towards) {
        return glm::dot(towards, kTowards) > std::cos(glm::radians(1.5)) ? glm::dvec3(4e4, 4e4, 2e4) : glm::dvec3(0.5);
      })));
  scene->environmentFiles.emplace("broken.hdr",
                                  std::make_shared<const EnvironmentFile>(Bytes{'#', '?', 'R', 'G', 'B', 'E'}));
  return scene;
}

FrameSpec specOf(const std::string& file) {
  FrameSpec spec;
  spec.environment.file = file;
  return spec;
}

std::string placeOfProblem(const FrameSpec& spec) {
  const auto settled = settleFrame(lit(), spec, nullptr);
  return settled ? "none" : settled.problems().front().pointer;
}

TEST(EnvironmentLights, FilesThatAreMissingOrBrokenAreRefusedAtTheirPlace) {
  EXPECT_EQ(placeOfProblem(specOf("moon.hdr")), "/environment/file");
  EXPECT_EQ(placeOfProblem(specOf("broken.hdr")), "/environment/file");
  FrameSpec bright = specOf("sun.hdr");
  bright.environment.intensity = 1e9;
  EXPECT_EQ(placeOfProblem(bright), "/environment/intensity");
}

TEST(EnvironmentLights, TheFoundSunIsTheOnlyLightAndStandsInTheReport) {
  FrameSpec spec = specOf("sun.hdr");
  spec.environment.rotationDegrees = 90; // clockwise from above: from +X to +Z
  spec.environment.intensity = 2;
  spec.shadow.strength = 0.5;
  const auto settled = settleFrame(lit(), spec, nullptr);
  ASSERT_TRUE(settled) << settled.problems().front().detail;
  const auto& lights = *settled->frame.spec.lights;
  ASSERT_EQ(lights.size(), 1u);
  const glm::dvec3 turned(-kTowards.z, kTowards.y, kTowards.x);
  EXPECT_GT(glm::dot(-directionOf(lights[0]), turned), std::cos(glm::radians(0.5))); // a third of a texel
  EXPECT_NEAR(*lights[0].angularDiameterDegrees, 3, 0.6);
  EXPECT_EQ((*lights[0].color)[0], 1);
  EXPECT_NEAR((*lights[0].color)[2], 0.5, 0.01);
  EXPECT_EQ(lights[0].shadow->strength, 0.5);
  ASSERT_TRUE(settled->environment.report && settled->environment.report->sun);
  EXPECT_EQ(settled->environment.report->width, 256);
  const SunReport& sun = *settled->environment.report->sun;
  EXPECT_NEAR(sun.lux, lights[0].intensity * luminanceOf({1, 1, (*lights[0].color)[2]}), 1e-6 * sun.lux);
}

TEST(EnvironmentLights, TheEffectiveSpecGivesTheSameLightsAgain) {
  const ScenePtr scene = lit();
  const auto first = settleFrame(scene, specOf("sun.hdr"), nullptr);
  ASSERT_TRUE(first);
  EXPECT_TRUE(first->environment.split) << "it was read for this frame";
  const auto again = settleFrame(scene, first->frame.spec, nullptr);
  ASSERT_TRUE(again);
  EXPECT_EQ(again->frame.spec, first->frame.spec);
  EXPECT_FALSE(again->environment.split) << "it is known";
  EXPECT_TRUE(again->environment.report->sun);
}

TEST(EnvironmentLights, ASunThatStaysInThePictureIsNoLight) {
  FrameSpec spec = specOf("sun.hdr");
  spec.environment.extractSun = SunExtraction::none;
  const auto settled = settleFrame(lit(), spec, nullptr);
  ASSERT_TRUE(settled);
  EXPECT_TRUE(settled->frame.spec.lights->empty());
  EXPECT_FALSE(settled->environment.report->sun);
  const auto studio = settleFrame(lit(), FrameSpec{}, nullptr);
  ASSERT_TRUE(studio);
  EXPECT_EQ(studio->frame.spec.lights->size(), 1u) << "the usual sun";
  EXPECT_FALSE(studio->environment.report);
}

TEST(EnvironmentLights, LightsThatAreAskedForComeBeforeTheSun) {
  FrameSpec spec = specOf("sun.hdr");
  Light lamp;
  lamp.direction = Vec3{0, -1, 0};
  spec.lights = std::vector{lamp};
  const auto settled = settleFrame(lit(), spec, nullptr);
  ASSERT_TRUE(settled);
  ASSERT_EQ(settled->frame.spec.lights->size(), 2u);
  EXPECT_EQ((*settled->frame.spec.lights)[0].intensity, lamp.intensity);
}

} // namespace
} // namespace gnomon
