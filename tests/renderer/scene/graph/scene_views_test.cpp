#include "renderer/scene/graph/scene_views.h"

#include "tests/renderer/scene/geometry.h"
#include "tests/renderer/scene/load.h"

namespace gnomon {
namespace {

using nlohmann::json;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

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

/// The cube stands on node 0, "far", below node 1.
Problems problemsOfPlace(const json& node, const json& parent = json::object()) {
  testing::GlbBuilder builder = testing::cube();
  builder.json["nodes"][0].update(node);
  builder.json["nodes"][0]["name"] = "far";
  builder.json["scenes"][0]["nodes"] = {1};
  json above = parent;
  above["children"] = {0};
  builder.add("nodes", above);
  return problemsOf(builder);
}

TEST(SceneViews, RefusesPlacesBeyondReachWithTheirNode) {
  const json beyond = {
      {{"translation", {3e9, 0, 0}}}, {{"translation", {0, -1e30, 0}}},
      {{"scale", {1e10, 1, 1}}},      {{"scale", {1e38, 1e38, 1e38}}},
      {{"scale", {1e308, 1, 1}}},     {{"translation", {0, 0, 2e9}}} // its box reaches on
  };
  for (const json& node : beyond) {
    const Problems problems = problemsOfPlace(node);
    ASSERT_THAT(problems, ElementsAre(ProblemAt(ProblemCode::invalidScene, "/nodes/0"))) << node;
    EXPECT_THAT(problems[0].actual, HasSubstr("\"far\""));
    EXPECT_THAT(problems[0].limit, HasSubstr("2e+09 metres"));
  }
  const json large = {{"scale", {1e6, 1e6, 1e6}}};
  EXPECT_THAT(problemsOfPlace(large), IsEmpty());
  EXPECT_THAT(problemsOfPlace(large, large), ElementsAre(ProblemAt(ProblemCode::invalidScene, "/nodes/0")));
  EXPECT_THAT(problemsOfPlace({{"translation", {1.9e9, -1.9e9, 1.9e9}}}), IsEmpty());
}

TEST(SceneViews, RefusesVerticesBeyondReach) {
  for (const float far : {2.1e9f, -1e19f, 3e38f}) {
    testing::GlbBuilder builder = testing::cube();
    std::memcpy(builder.binary.data(), &far, sizeof far); // of the first position
    for (const char* bound : {"min", "max"}) builder.json["accessors"][0].erase(bound);
    EXPECT_THAT(problemsOf(builder), ElementsAre(ProblemAt(ProblemCode::invalidScene, "/nodes/0"))) << far;
    builder.json["nodes"][0]["scale"] = {1e-30, 1e-30, 1e-30};
    EXPECT_THAT(problemsOf(builder), IsEmpty()) << "where it stands counts";
  }
}

TEST(SceneViews, LeavesOutInstancesWithoutAnAreaWithAWarning) {
  for (const json& scale : {json{0, 0, 0}, json{1, 0, 0}, json{0, 0, -2}}) {
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

TEST(SceneViews, WhatOneScaleOf0FlattensKeepsItsFrontSide) {
  for (const json& scale : {json{1, 0, 1}, json{-1, 0, 1}, json{0, 2, -1}, json{1, -1, 0}}) {
    testing::GlbBuilder builder = testing::cube();
    builder.json["nodes"][0]["scale"] = scale;
    const Scene scene = load(builder);
    ASSERT_EQ(scene.scenes[0].instances.size(), 1u) << scale;
    EXPECT_THAT(scene.summary.warnings, IsEmpty());
    const bool mirrored = std::ranges::count_if(scale, [](const json& each) { return each < 0; }) % 2 == 1;
    EXPECT_EQ(glm::determinant(glm::dmat3(scene.scenes[0].instances[0].worldFromLocal)) < 0, mirrored) << scale;
  }
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
}

/// The x of each instance, by nodes that are moved by 1, 10, 100 and so on.
std::vector<double> placesOf(const json& children, const json& scenes, std::vector<std::string>& warnings) {
  testing::GlbBuilder builder = testing::cube();
  builder.json["nodes"] = json::array();
  double step = 1;
  for (const json& each : children) {
    json node = {{"mesh", 0}, {"translation", {step, 0, 0}}};
    if (!each.empty()) node["children"] = each;
    builder.add("nodes", std::move(node));
    step *= 10;
  }
  builder.json["scenes"] = json::array();
  for (const json& roots : scenes) builder.add("scenes", {{"nodes", roots}});
  const Scene scene = load(builder);
  warnings = scene.summary.warnings;
  std::vector<double> places;
  for (const SceneView& view : scene.scenes) {
    for (const Instance& instance : view.instances) places.push_back(instance.worldFromLocal[3].x);
  }
  return places;
}

TEST(SceneViews, ANodeThatASceneListsBesideItsParentIsDrawnOnce) {
  std::vector<std::string> said;
  const auto expectTold = [&] { EXPECT_THAT(said, ElementsAre(HasSubstr("child of another"))); };
  const json none = json::array();
  EXPECT_THAT(placesOf({{1}, none}, {{0, 1}}, said), ElementsAre(1, 11));
  expectTold();
  EXPECT_THAT(placesOf({{1}, {2}, none}, {{2, 1, 0}}, said), ElementsAre(1, 11, 111));
  expectTold();
  EXPECT_THAT(placesOf({{1}, {2}, none}, {{0, 2}}, said), ElementsAre(1, 11, 111));
  expectTold();
}

TEST(SceneViews, AParentThatNoSceneListsMovesNothing) {
  std::vector<std::string> said;
  const json none = json::array();
  EXPECT_THAT(placesOf({{1}, none}, {{1}}, said), ElementsAre(10));
  EXPECT_THAT(said, ElementsAre(HasSubstr("child of another")));
  EXPECT_THAT(placesOf({{1}, {2}, none}, {{1, 2}}, said), ElementsAre(10, 110));
  EXPECT_THAT(placesOf({{1}, none}, {{0}, {1}}, said), ElementsAre(1, 11, 11)) << "another scene has it";
}

TEST(SceneViews, CesiumRtcMovesEverything) {
  testing::GlbBuilder builder = testing::cube();
  builder.json["nodes"][0]["children"] = {1};
  builder.add("nodes", {{"mesh", 0}, {"translation", {1, 0, 0}}});
  builder.addRoot({{"mesh", 0}, {"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 2, 0, 1}}});
  builder.json["extensionsUsed"] = builder.json["extensionsRequired"] = {"CESIUM_RTC"};
  builder.json["extensions"]["CESIUM_RTC"]["center"] = {6378137.5, 10, -3};
  const Scene scene = load(builder);
  EXPECT_THAT(scene.summary.warnings, IsEmpty());
  const std::vector<Instance>& instances = scene.scenes[0].instances;
  ASSERT_EQ(instances.size(), 3u);
  expectNear(glm::dvec3(instances[0].worldFromLocal[3]), {6378137.5, 10, -3});
  expectNear(glm::dvec3(instances[1].worldFromLocal[3]), {6378138.5, 10, -3});
  expectNear(glm::dvec3(instances[2].worldFromLocal[3]), {6378137.5, 12, -3});
}

TEST(SceneViews, TheLastRowOfAMatrixMayBeRounded) {
  testing::GlbBuilder builder = testing::cube();
  builder.json["nodes"][0]["matrix"] = {2, 0, 0, 1e-6, 0, 2, 0, 0, 0, 0, 2, 0, 4, 0, 0, 0.99999994};
  const Scene scene = load(builder);
  EXPECT_EQ(scene.scenes[0].instances.at(0).worldFromLocal, glm::dmat4(2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 4, 0, 0, 1));
  EXPECT_THAT(scene.summary.warnings, ElementsAre(HasSubstr("/nodes/0/matrix")));
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
  expectLimit(builder, &Limits::maxTriangles, 120, "/scenes/0");
  expectLimit(builder, &Limits::maxInstances, 20, "/scenes/0");
  for (int i = 0; i < 30; ++i) builder.add("scenes", {{"nodes", {0}}});
  Limits limits;
  limits.maxInstances = 60;
  EXPECT_FALSE(problemsOf(builder, limits).empty()) << "over all scenes";
}

} // namespace
} // namespace gnomon
