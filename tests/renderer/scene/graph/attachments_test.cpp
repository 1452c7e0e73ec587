#include "renderer/scene/graph/attachments.h"

#include <cmath>
#include <numbers>

#include "tests/renderer/scene/geometry.h"
#include "tests/renderer/scene/load.h"

namespace gnomon {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

json perspective() {
  return {{"type", "perspective"}, {"perspective", {{"yfov", 1.0}, {"znear", 0.5}, {"zfar", 20.0}}}};
}

TEST(Cameras, StandWhereTheirNodeStands) {
  testing::GlbBuilder builder = testing::cube();
  builder.add("cameras", perspective());
  builder.addRoot({{"camera", 0}, {"name", "Eye"}, {"translation", {1, 2, 3}}, {"rotation", kQuarterAroundY}});
  const Scene scene = load(builder);
  ASSERT_EQ(scene.scenes[0].cameras.size(), 1u);
  const SceneCamera& camera = scene.scenes[0].cameras[0];
  EXPECT_EQ(camera.node, 1);
  EXPECT_EQ(camera.name, "Eye");
  expectNear(camera.eye, {1, 2, 3});
  expectNear(camera.forward, {-1, 0, 0});
  expectNear(camera.up, {0, 1, 0});
  ASSERT_TRUE(camera.perspective && !camera.orthographic);
  EXPECT_NEAR(camera.perspective->fovYDegrees, 180 / std::numbers::pi, 1e-12);
  EXPECT_EQ(camera.perspective->near, 0.5);
  EXPECT_EQ(camera.perspective->far, 20.0);
}

TEST(Cameras, ScaleDoesNotMatter) {
  for (const json& scale : {json{3, 3, 3}, json{1, 5, 0.1}, json{-1, 1, 1}, json{1, 1, -1}, json{-2, -2, -2}}) {
    testing::GlbBuilder builder = testing::cube();
    builder.add("cameras", perspective());
    builder.addRoot({{"camera", 0}, {"scale", scale}, {"rotation", kQuarterAroundY}});
    const SceneCamera camera = load(builder).scenes[0].cameras.at(0);
    expectNear(camera.forward, {-1, 0, 0});
    expectNear(camera.up, {0, 1, 0});
  }
}

TEST(Cameras, AxesStayOrthonormalUnderAShear) {
  testing::GlbBuilder builder = testing::cube();
  builder.add("cameras", perspective());
  const double s = std::sin(0.3);
  const double c = std::cos(0.3);
  builder.addRoot({{"children", {2}}, {"scale", {1, 10, 1}}});
  builder.add("nodes", {{"camera", 0}, {"rotation", {s, 0, 0, c}}});
  const SceneCamera camera = load(builder).scenes[0].cameras.at(0);
  EXPECT_NEAR(glm::length(camera.forward), 1, 1e-12);
  EXPECT_NEAR(glm::length(camera.up), 1, 1e-12);
  EXPECT_NEAR(glm::dot(camera.forward, camera.up), 0, 1e-12);
}

TEST(Cameras, ReadsOrthographicLenses) {
  testing::GlbBuilder builder;
  builder.add("cameras",
              {{"type", "orthographic"}, {"orthographic", {{"xmag", 4}, {"ymag", 3}, {"znear", 0}, {"zfar", 9}}}});
  builder.addRoot({{"camera", 0}});
  const Scene scene = load(builder);
  const SceneCamera& camera = scene.scenes[0].cameras.at(0);
  ASSERT_TRUE(camera.orthographic && !camera.perspective);
  EXPECT_EQ(camera.orthographic->height, 6);
  EXPECT_EQ(camera.orthographic->near, 0);
  EXPECT_EQ(camera.orthographic->far, 9);
  ASSERT_EQ(scene.summary.cameras.size(), 1u);
  EXPECT_EQ(scene.summary.cameras[0].type, "orthographic");
}

Problems strictProblemsOf(const testing::GlbBuilder& builder) {
  SceneBundle strict = builder.bundle();
  strict.strict = true;
  return problemsOf(strict);
}

TEST(Cameras, BrokenLensesAreLeftOutAndTellWhy) {
  const auto expectLeftOut = [](const json& camera, const std::string& pointer) {
    testing::GlbBuilder builder = testing::cube();
    builder.add("cameras", camera);
    builder.addRoot({{"camera", 0}, {"name", "Eye"}});
    const Scene scene = load(builder);
    EXPECT_THAT(scene.scenes[0].cameras, IsEmpty());
    EXPECT_THAT(scene.summary.warnings, ElementsAre(AllOf(HasSubstr("the camera is left out"), HasSubstr(pointer))));
    ASSERT_EQ(scene.leftOutCameras.size(), 1u);
    EXPECT_EQ(scene.leftOutCameras[0].node, 1);
    EXPECT_EQ(scene.leftOutCameras[0].name, "Eye");
    EXPECT_THAT(scene.leftOutCameras[0].why, HasSubstr(pointer));
    EXPECT_THAT(strictProblemsOf(builder), ElementsAre(ProblemAt(ProblemCode::invalidScene, pointer)));
  };
  json camera = perspective();
  camera["perspective"]["zfar"] = 0.5;
  expectLeftOut(camera, "/cameras/0/perspective/zfar");
  camera["perspective"] = {{"yfov", 4}, {"znear", 1}};
  expectLeftOut(camera, "/cameras/0/perspective/yfov");
  camera["perspective"] = {{"yfov", 3.1417}, {"znear", 1}};
  const Scene wide = load([&] {
    testing::GlbBuilder builder = testing::cube();
    builder.add("cameras", camera);
    return builder;
  }());
  EXPECT_THAT(wide.summary.warnings, ElementsAre(HasSubstr("rounding"), HasSubstr("180 degrees")));
  camera.erase("perspective");
  expectLeftOut(camera, "/cameras/0/perspective");
  camera = {{"type", "orthographic"}, {"orthographic", {{"xmag", 4}, {"ymag", 1.5e308}, {"znear", 0}, {"zfar", 9}}}};
  expectLeftOut(camera, "/cameras/0/orthographic/ymag");
  camera = {{"type", "fisheye"}, {"name", "fish"}};
  expectLeftOut(camera, "/cameras/0/type");
}

TEST(Cameras, ScaledToNothingAreLeftOut) {
  testing::GlbBuilder builder;
  builder.add("cameras", perspective());
  builder.addRoot({{"children", {1}}, {"scale", {0, 0, 0}}});
  builder.add("nodes", {{"camera", 0}});
  const Scene scene = load(builder);
  EXPECT_THAT(scene.scenes[0].cameras, IsEmpty());
  EXPECT_THAT(scene.summary.warnings, ElementsAre(HasSubstr("camera at node 1")));
}

TEST(Cameras, VeryLongNamesAreCutWithAWarning) {
  testing::GlbBuilder builder;
  builder.add("cameras", perspective());
  std::string name = "x";
  for (int i = 0; i < 1000; ++i) name += "\xC3\xA4"; // two bytes each, so that the cut falls inside one
  builder.addRoot({{"camera", 0}, {"name", name}});
  const Scene scene = load(builder);
  EXPECT_EQ(scene.scenes[0].cameras.at(0).name, name.substr(0, 255));
  EXPECT_THAT(scene.summary.warnings, ElementsAre(HasSubstr("cut to 256 bytes")));
}

using nlohmann::json;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// A file with one light on a node that is turned a quarter around Y and scaled.
testing::GlbBuilder lit(const json& light) {
  testing::GlbBuilder builder;
  builder.json["extensions"]["KHR_lights_punctual"]["lights"] = {light};
  builder.addRoot({{"translation", {1, 2, 3}},
                   {"rotation", kQuarterAroundY},
                   {"scale", {2, 0.5, -3}},
                   {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  return builder;
}

TEST(Lights, ReadsDirectionalLights) {
  const Scene scene = load(lit({{"type", "directional"}, {"intensity", 5}, {"color", {1, 0.5, 0}}, {"name", "Sun"}}));
  const SceneLight& placed = scene.scenes[0].lights.at(0);
  EXPECT_EQ(placed.name, "Sun");
  EXPECT_EQ(placed.light.type, LightType::directional);
  ASSERT_TRUE(placed.light.direction);
  expectNear(toDvec3(*placed.light.direction), {-1, 0, 0});
  EXPECT_FALSE(placed.light.position);
  EXPECT_EQ(placed.light.intensity, 5);
  EXPECT_EQ(*placed.light.color, (Vec3{1, 0.5, 0}));
  EXPECT_EQ(scene.summary.lights.at(0).type, "directional");
}

TEST(Lights, G1_ReadsSpotLightsWhoseConesAreHalfAngles) {
  const Light light =
      load(lit({{"type", "spot"}, {"range", 7}, {"spot", {{"innerConeAngle", 0.25}, {"outerConeAngle", 0.5}}}}))
          .scenes[0]
          .lights.at(0)
          .light;
  EXPECT_EQ(light.type, LightType::spot);
  expectNear(toDvec3(light.direction.value()), {-1, 0, 0});
  expectNear(toDvec3(light.position.value()), {1, 2, 3});
  EXPECT_EQ(light.range, 7.0);
  EXPECT_NEAR(light.innerConeDegrees, 0.25 * 180 / std::numbers::pi, 1e-12);
  EXPECT_NEAR(light.outerConeDegrees, 0.5 * 180 / std::numbers::pi, 1e-12);
  EXPECT_EQ(light.intensity, 1);
}

TEST(Lights, X31_AShearedNodeTurnsASpotButDoesNotBendIt) {
  // Scaled by its parent after it is turned, the node's axes no longer meet at right angles.
  testing::GlbBuilder builder;
  builder.json["extensions"]["KHR_lights_punctual"]["lights"] = {
      {{"type", "spot"}, {"spot", {{"innerConeAngle", 0.25}, {"outerConeAngle", 0.5}}}}};
  const double half = std::numbers::pi / 12; // 30 degrees around Y: the light looks along (-1/2, 0, -sqrt(3)/2)
  builder.addRoot({{"scale", {4, 1, 1}}, {"children", {1}}});
  builder.add("nodes", {{"rotation", {0, std::sin(half), 0, std::cos(half)}},
                        {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  const Light light = load(builder).scenes[0].lights.at(0).light;
  const double length = std::hypot(2, std::sqrt(0.75));
  expectNear(toDvec3(light.direction.value()), {-2 / length, 0, -std::sqrt(0.75) / length});
  EXPECT_NEAR(light.outerConeDegrees, 0.5 * 180 / std::numbers::pi, 1e-12);
}

TEST(Lights, G1_ReadsPointLightsWithoutARange) {
  const Light light = load(lit({{"type", "point"}})).scenes[0].lights.at(0).light;
  EXPECT_EQ(light.type, LightType::point);
  EXPECT_FALSE(light.direction);
  EXPECT_FALSE(light.range) << "absent = infinite";
  expectNear(toDvec3(light.position.value()), {1, 2, 3});
}

TEST(Lights, ColorsBeyondOneBecomeIntensity) {
  const Light light =
      load(lit({{"type", "point"}, {"color", {4, 2, 0}}, {"intensity", 3}})).scenes[0].lights.at(0).light;
  EXPECT_EQ(*light.color, (Vec3{1, 0.5, 0}));
  EXPECT_EQ(light.intensity, 12);
}

TEST(Lights, HalfSphereConesAreNarrowedWithAWarning) {
  const Scene scene = load(lit({{"type", "spot"}, {"spot", {{"outerConeAngle", std::numbers::pi / 2}}}}));
  EXPECT_EQ(scene.scenes[0].lights.at(0).light.outerConeDegrees, 89.9);
  EXPECT_THAT(scene.summary.warnings, Contains(HasSubstr("90 degrees")));
}

TEST(Lights, BrokenOnesAreLeftOut) {
  const std::string lights = "/extensions/KHR_lights_punctual/lights/0";
  const std::pair<json, const char*> faults[] = {
      {{{"type", "spot"}}, "/spot"},
      {{{"type", "spot"}, {"spot", {{"innerConeAngle", 0.8}}}}, "/spot/innerConeAngle"},
      {{{"type", "point"}, {"range", 0}}, "/range"},
      {{{"type", "point"}, {"intensity", -1}}, "/intensity"},
      {{{"type", "point"}, {"intensity", 1e200}, {"color", {1, 1e200, 1}}}, "/intensity"},
      {{{"type", "ambient"}}, "/type"}};
  for (const auto& [light, member] : faults) {
    const Scene scene = load(lit(light));
    EXPECT_THAT(scene.scenes[0].lights, IsEmpty()) << light;
    EXPECT_THAT(scene.summary.warnings,
                ElementsAre(AllOf(HasSubstr("the light is left out"), HasSubstr(lights + member))));
    EXPECT_THAT(strictProblemsOf(lit(light)), ElementsAre(ProblemAt(ProblemCode::invalidScene, lights + member)));
  }
}

TEST(Lights, ConesThatAreTheSameHaveASharpEdge) {
  for (const double inner : {0.5, 0.50001}) {
    const Scene scene = load(lit({{"type", "spot"}, {"spot", {{"innerConeAngle", inner}, {"outerConeAngle", 0.5}}}}));
    const Light light = scene.scenes[0].lights.at(0).light;
    EXPECT_EQ(light.innerConeDegrees, light.outerConeDegrees);
    EXPECT_THAT(scene.summary.warnings, ElementsAre(HasSubstr("sharp")));
  }
}

} // namespace
} // namespace gnomon
