#include "renderer/scene/scene_views.h"

#include <cmath>
#include <numbers>

#include "tests/renderer/scene/load.h"

namespace gnomon {
namespace {

using nlohmann::json;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr double kHalf = std::numbers::sqrt2 / 2;
const json kQuarterAroundY = {0, kHalf, 0, kHalf}; ///< +Z to +X, so -Z to -X

void expectNear(const glm::dvec3& actual, const glm::dvec3& expected, double tolerance = 1e-12) {
  EXPECT_LT(glm::length(actual - expected), tolerance) << actual.x << " " << actual.y << " " << actual.z << " is not "
                                                       << expected.x << " " << expected.y << " " << expected.z;
}

glm::dvec3 toDvec3(const Vec3& v) {
  return {v[0], v[1], v[2]};
}

TEST(SceneViews, ComposesTransformsInDoublePrecision) {
  testing::GlbBuilder builder = testing::cube();
  builder.json["nodes"][0]["translation"] = {0.001, 0, 0};
  builder.json["nodes"][0]["scale"] = {2, 3, 4};
  builder.json["scenes"][0]["nodes"] = {1};
  builder.add("nodes", {{"children", {0}}, {"translation", {1e7, 0, 0}}, {"rotation", kQuarterAroundY}});
  const Scene scene = load(builder);
  ASSERT_EQ(scene.scenes[0].instances.size(), 1u);
  const Instance& instance = scene.scenes[0].instances[0];
  EXPECT_EQ(instance.node, 0);
  expectNear(glm::dvec3(instance.worldFromLocal[3]), {1e7, 0, -0.001}, 1e-8);
  expectNear(glm::dvec3(instance.worldFromLocal[2]), {4, 0, 0});
  expectNear(instance.bounds.halfExtent(), {4, 3, 2}, 1e-6);
  EXPECT_EQ(scene.scenes[0].bounds.min, instance.bounds.min);
}

TEST(SceneViews, ReadsMatrices) {
  testing::GlbBuilder builder = testing::cube();
  builder.json["nodes"][0]["matrix"] = {0, 0, -2, 0, 0, 1, 0, 0, 1, 0, 0, 0, 5, 6, 7, 1};
  const glm::dmat4 matrix = load(builder).scenes[0].instances.at(0).worldFromLocal;
  expectNear(glm::dvec3(matrix[0]), {0, 0, -2});
  expectNear(glm::dvec3(matrix[3]), {5, 6, 7});
}

TEST(SceneViews, RefusesBrokenTransforms) {
  const auto problems = [](json node) {
    testing::GlbBuilder builder = testing::cube();
    node["mesh"] = 0;
    builder.json["nodes"][0] = std::move(node);
    return problemsOf(builder);
  };
  const json identity = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  json projective = identity;
  projective[3] = 0.5;
  EXPECT_THAT(problems({{"matrix", projective}}), ElementsAre(ProblemAt(ProblemCode::invalidScene, "/nodes/0/matrix")));
  EXPECT_THAT(problems({{"matrix", identity}, {"scale", {1, 1, 1}}}),
              ElementsAre(ProblemAt(ProblemCode::invalidScene, "/nodes/0/matrix")));
  EXPECT_THAT(problems({{"rotation", {0, 0, 0, 0}}}),
              ElementsAre(ProblemAt(ProblemCode::invalidScene, "/nodes/0/rotation")));
}

TEST(SceneViews, RefusesPlacesThatAreNotFinite) {
  testing::GlbBuilder builder = testing::cube();
  builder.json["nodes"][0]["scale"] = {1e300, 1e300, 1e300};
  builder.json["scenes"][0]["nodes"] = {1};
  builder.add("nodes", {{"children", {0}}, {"scale", {1e300, 1e300, 1e300}}});
  EXPECT_THAT(problemsOf(builder), ElementsAre(ProblemAt(ProblemCode::invalidScene, "/nodes/0")));
}

TEST(SceneViews, LeavesOutFlatInstancesWithAWarning) {
  for (const json& scale : {json{0, 0, 0}, json{1, 0, 1}}) {
    testing::GlbBuilder builder = testing::cube();
    builder.json["nodes"][0]["scale"] = scale;
    const Scene scene = load(builder);
    EXPECT_THAT(scene.scenes[0].instances, IsEmpty());
    EXPECT_THAT(scene.summary.warnings, ElementsAre(HasSubstr("node 0")));
  }
  testing::GlbBuilder tiny = testing::cube();
  tiny.json["nodes"][0]["scale"] = {1e-9, 1e-9, -1e-9};
  EXPECT_EQ(load(tiny).scenes[0].instances.size(), 1u);
}

TEST(SceneViews, RefusesCyclesAndSharedChildren) {
  const auto problems = [](json nodes, json roots) {
    testing::GlbBuilder builder;
    builder.json["nodes"] = std::move(nodes);
    builder.json["scenes"] = {{{"nodes", std::move(roots)}}};
    return problemsOf(builder);
  };
  EXPECT_THAT(problems({{{"children", {0}}}}, json::array()),
              ElementsAre(ProblemAt(ProblemCode::invalidScene, "/nodes/0")));
  EXPECT_THAT(
      problems({{{"children", {1}}}, {{"children", {0}}}}, json::array()),
      ElementsAre(ProblemAt(ProblemCode::invalidScene, "/nodes/0"), ProblemAt(ProblemCode::invalidScene, "/nodes/1")));
  EXPECT_THAT(problems({{{"children", {2}}}, {{"children", {2}}}, json::object()}, {0, 1}),
              ElementsAre(ProblemAt(ProblemCode::invalidScene, "/nodes/1/children/0")));
  EXPECT_THAT(problems({{{"children", {1}}}, json::object()}, {0, 1}),
              ElementsAre(ProblemAt(ProblemCode::invalidScene, "/scenes/0/nodes/1")));
}

TEST(SceneViews, DeepTreesNeedNoStack) {
  testing::GlbBuilder builder = testing::cube();
  builder.json["nodes"] = json::array();
  for (int i = 0; i < 50'000; ++i) builder.add("nodes", {{"children", {i + 1}}, {"translation", {1, 0, 0}}});
  builder.add("nodes", {{"mesh", 0}});
  EXPECT_EQ(load(builder).scenes[0].instances.at(0).worldFromLocal[3].x, 50'000);
}

TEST(SceneViews, EachSceneStandsAlone) {
  testing::GlbBuilder builder = testing::cube();
  builder.json["scenes"] = json::parse(R"([{"nodes": [2, 1]}, {}, {"nodes": [0]}])");
  builder.json["scene"] = 2;
  builder.add("nodes", {{"mesh", 0}, {"translation", {10, 0, 0}}});
  builder.add("nodes", {{"mesh", 0}});
  const Scene scene = load(builder);
  ASSERT_EQ(scene.scenes.size(), 3u);
  EXPECT_EQ(scene.defaultScene, 2);
  ASSERT_EQ(scene.scenes[0].instances.size(), 2u);
  EXPECT_EQ(scene.scenes[0].instances[0].node, 1) << "in the order of the file's nodes";
  EXPECT_EQ(scene.scenes[0].instances[1].node, 2);
  EXPECT_EQ(scene.scenes[0].triangles, 24u);
  EXPECT_TRUE(scene.scenes[1].bounds.empty());
  EXPECT_EQ(scene.scenes[2].triangles, 12u);
  EXPECT_EQ(scene.summary.scenes, 3);
  EXPECT_EQ(scene.summary.triangles, 12u);
}

TEST(SceneViews, AFileWithoutScenesIsOneSceneOfItsRoots) {
  testing::GlbBuilder builder = testing::cube();
  builder.json.erase("scenes");
  builder.add("nodes", {{"children", {0}}});
  const Scene scene = load(builder);
  ASSERT_EQ(scene.scenes.size(), 1u);
  EXPECT_EQ(scene.scenes[0].instances.size(), 1u);
  EXPECT_EQ(scene.summary.nodes, 2u);
}

TEST(SceneViews, AnEmptyFileIsAScene) {
  const Scene scene = load(testing::GlbBuilder{});
  ASSERT_EQ(scene.scenes.size(), 1u);
  EXPECT_TRUE(scene.scenes[0].bounds.empty());
  EXPECT_EQ(scene.materials.size(), 1u);
}

TEST(SceneViews, ReuseIsHeldAgainstTheLimits) {
  testing::GlbBuilder builder = testing::cube();
  for (int i = 0; i < 9; ++i) builder.addMeshNode(0);
  Limits limits;
  limits.maxTriangles = 120;
  EXPECT_EQ(load(builder, limits).summary.triangles, 120u);
  limits.maxTriangles = 119;
  EXPECT_THAT(problemsOf(builder, limits), ElementsAre(ProblemAt(ProblemCode::tooLarge, "/scenes/0")));
  limits = {};
  limits.maxInstances = 20;
  EXPECT_THAT(problemsOf(builder, limits), IsEmpty());
  limits.maxInstances = 19;
  EXPECT_THAT(problemsOf(builder, limits), ElementsAre(ProblemAt(ProblemCode::tooLarge, "/scenes/0")));
  for (int i = 0; i < 30; ++i) builder.add("scenes", {{"nodes", {0}}});
  limits.maxInstances = 60;
  EXPECT_FALSE(problemsOf(builder, limits).empty()) << "over all scenes";
}

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

TEST(Cameras, RefusesBrokenLenses) {
  const auto problems = [](const json& camera) {
    testing::GlbBuilder builder;
    builder.add("cameras", camera);
    return problemsOf(builder);
  };
  json camera = perspective();
  camera["perspective"]["zfar"] = 0.5;
  EXPECT_THAT(problems(camera), ElementsAre(ProblemAt(ProblemCode::invalidScene, "/cameras/0/perspective/zfar")));
  camera["perspective"] = {{"yfov", 4}, {"znear", 1}};
  EXPECT_THAT(problems(camera), ElementsAre(ProblemAt(ProblemCode::invalidScene, "/cameras/0/perspective/yfov")));
  camera.erase("perspective");
  EXPECT_THAT(problems(camera), ElementsAre(ProblemAt(ProblemCode::invalidScene, "/cameras/0/perspective")));
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
  EXPECT_EQ(placed.light.color, (Vec3{1, 0.5, 0}));
  EXPECT_EQ(scene.summary.lights.at(0).type, "directional");
}

TEST(Lights, ReadsSpotLights) {
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

TEST(Lights, ReadsPointLights) {
  const Light light = load(lit({{"type", "point"}})).scenes[0].lights.at(0).light;
  EXPECT_EQ(light.type, LightType::point);
  EXPECT_FALSE(light.direction);
  EXPECT_FALSE(light.range) << "absent = infinite";
  expectNear(toDvec3(light.position.value()), {1, 2, 3});
}

TEST(Lights, ColorsBeyondOneBecomeIntensity) {
  const Light light =
      load(lit({{"type", "point"}, {"color", {4, 2, 0}}, {"intensity", 3}})).scenes[0].lights.at(0).light;
  EXPECT_EQ(light.color, (Vec3{1, 0.5, 0}));
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
