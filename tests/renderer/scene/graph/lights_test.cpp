#include "renderer/scene/graph/lights.h"

#include <cmath>
#include <numbers>

#include "tests/renderer/scene/geometry.h"
#include "tests/renderer/scene/load.h"

namespace gnomon {
namespace {

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

TEST(Lights, RefusesBrokenLights) {
  const std::string lights = "/extensions/KHR_lights_punctual/lights/0";
  EXPECT_THAT(problemsOf(lit({{"type", "spot"}})), ElementsAre(ProblemAt(ProblemCode::invalidScene, lights + "/spot")));
  EXPECT_THAT(problemsOf(lit({{"type", "spot"}, {"spot", {{"innerConeAngle", 0.8}}}})),
              ElementsAre(ProblemAt(ProblemCode::invalidScene, lights + "/spot/innerConeAngle")));
  EXPECT_THAT(problemsOf(lit({{"type", "point"}, {"range", 0}})),
              ElementsAre(ProblemAt(ProblemCode::invalidScene, lights + "/range")));
  EXPECT_THAT(problemsOf(lit({{"type", "point"}, {"intensity", -1}})),
              ElementsAre(ProblemAt(ProblemCode::invalidScene, lights + "/intensity")));
}

} // namespace
} // namespace gnomon
