// Shadows of what is in view are as fine however far off an orthographic eye or a lamp is.
#include "tests/renderer/box_over_ground.h"

namespace gnomon {
namespace {

using testing::BoxOverGround;
using testing::Sight;
using testing::Source;

const glm::dvec3 kTowardsSun = glm::normalize(glm::dvec3(-0.8, 0.57, -0.14));

Json sunOver() {
  return {{"direction", {-kTowardsSun.x, -kTowardsSun.y, -kTowardsSun.z}}};
}

/// A cube of 2 cm, 2 cm above a ground of 1 m.
BoxOverGround smallBox() {
  return {0.5, {-0.01, 0.02, -0.01}, {0.01, 0.04, 0.01}};
}

Sight parallelFrom(double metres, double far) {
  Sight sight;
  sight.eye = glm::dvec3(metres);
  sight.target = {0, 0, 0};
  sight.fovYDegrees = 0;
  sight.height = 0.16;
  sight.far = far;
  return sight;
}

TEST(FarPlaces, AnOrthographicPictureDoesNotDependOnTheDistanceOfItsEye) {
  const ScenePtr scene = testing::sceneOf(smallBox().builder());
  const auto expected = testing::shownOf(smallBox(), parallelFrom(1, 4000), {kTowardsSun, false});
  ASSERT_GT(testing::countsOf(expected).shadowed, 200);
  for (Json shadow : {Json::object(), Json{{"filter", {{"type", "hard"}}}}, Json{{"filter", {{"type", "vsm"}}}},
                      Json{{"technique", "rayTraced"}}}) {
    shadow["size"] = "XLarge";
    const Json spec = {{"lights", {sunOver()}}, {"shadow", shadow}};
    const auto nearby = testing::shownOf(testing::shadowFrame(scene, parallelFrom(1, 40), spec));
    EXPECT_LE(testing::differing(nearby, expected), 60) << shadow;
    for (const auto& [metres, far] : {std::pair(1000.0, 4000.0), std::pair(100000.0, 400000.0)}) {
      const auto shown = testing::shownOf(testing::shadowFrame(scene, parallelFrom(metres, far), spec));
      EXPECT_LE(testing::differing(shown, expected), testing::differing(nearby, expected) + 8) << shadow << metres;
    }
  }
}

TEST(FarPlaces, DepthsAreToldFromTheEyeThatWasAskedFor) {
  const ScenePtr scene = testing::sceneOf(smallBox().builder());
  const Sight sight = parallelFrom(1000, 4000);
  Json spec = {{"lights", {sunOver()}}, {"width", 64},
               {"height", 36},          {"camera", sight.camera()},
               {"views", {"depth"}},    {"output", {{"format", "exr"}, {"exrPixelType", "float"}}}};
  const double distance = std::sqrt(3.0) * 1000;
  Frame frame = testing::renderJson(scene, spec.dump());
  // The picture's middle shows the ground's below the box, or the box.
  EXPECT_NEAR(testing::valueAt(frame, 0.5, 0.5), distance, 0.08);
  EXPECT_NEAR(frame.report.depthRange[0], distance, 0.5);
  const LightReport& light = frame.report.lights[0];
  ASSERT_FALSE(light.tiles.empty());
  EXPECT_NEAR(light.tiles.front().near, frame.report.depthRange[0], 0.05);
  EXPECT_NEAR(light.tiles.back().far, frame.report.depthRange[1], 0.05);
  ASSERT_TRUE(light.depthRange);
  spec["shadow"] = {{"depthRange", {{"previous", {{"near", light.depthRange->near}, {"far", light.depthRange->far}}}}}};
  frame = testing::renderJson(scene, spec.dump());
  ASSERT_TRUE(frame.report.lights[0].depthRange);
  EXPECT_EQ(frame.report.lights[0].depthRange->near, light.depthRange->near) << "held";
  spec["shadow"] = {{"depthRange", {{"mode", "manual"}, {"min", distance - 1}, {"max", distance + 1}}}};
  frame = testing::renderJson(scene, spec.dump());
  EXPECT_NEAR(frame.report.lights[0].tiles.front().near, distance - 1, 1e-6);
}

TEST(FarPlaces, ASpotThrowsTheShadowsOfSmallThingsHoweverFarItIs) {
  const BoxOverGround box;
  const ScenePtr scene = testing::sceneOf(box.builder());
  const Sight sight;
  for (const double metres : {30.0, 29000.0, 1e6}) {
    const glm::dvec3 at = kTowardsSun * metres;
    const Json lamp = {{"type", "spot"},
                       {"position", {at.x, at.y, at.z}},
                       {"direction", {-at.x, -at.y, -at.z}},
                       {"outerConeDegrees", std::min(40.0, 57.3 * 60 / metres)},
                       {"innerConeDegrees", 0},
                       {"intensity", 1000}};
    const auto expected = testing::shownOf(box, sight, {at, true});
    for (const char* filter : {"pcf", "hard"}) {
      const Json shadow = {{"size", "XLarge"}, {"filter", {{"type", filter}}}};
      const Json spec = {{"lights", {lamp}}, {"shadow", shadow}};
      const auto shown = testing::shownOf(testing::shadowFrame(scene, sight, spec));
      EXPECT_GT(testing::countsOf(expected).shadowed, 500);
      EXPECT_LE(testing::differing(shown, expected), testing::countsOf(expected).shadowed / 8) << metres << shadow;
    }
  }
}

} // namespace
} // namespace gnomon
