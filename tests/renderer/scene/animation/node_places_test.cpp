#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "renderer/scene/animation/posed_scene.h"
#include "tests/renderer/scene/animation/animated.h"
#include "tests/renderer/scene/load.h"

namespace gnomon {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

NodeOptions placed(std::variant<int, std::string> node) {
  NodeOptions entry;
  entry.node = std::move(node);
  return entry;
}

NodeOptions movedTo(std::variant<int, std::string> node, const Vec3& translation) {
  NodeOptions entry = placed(std::move(node));
  entry.translation = translation;
  return entry;
}

std::shared_ptr<const Scene> posed(const std::shared_ptr<const Scene>& scene, const std::vector<NodeOptions>& nodes,
                                   const std::optional<AnimationMoment>& moment = {}) {
  const auto result = posedScene(scene, {moment, nodes});
  if (result) return *result;
  ADD_FAILURE() << result.problems().front().detail;
  return scene;
}

Problem problemOf(const std::shared_ptr<const Scene>& scene, const std::vector<NodeOptions>& nodes) {
  const auto result = posedScene(scene, {.nodes = nodes});
  EXPECT_FALSE(result);
  return result ? Problem{} : result.problems().front();
}

/// Everything that a frame places by, bit for bit.
void expectSame(const Scene& a, const Scene& b) {
  ASSERT_EQ(a.scenes.size(), b.scenes.size());
  for (std::size_t i = 0; i < a.scenes.size(); ++i) {
    const SceneView& one = a.scenes[i];
    const SceneView& other = b.scenes[i];
    EXPECT_EQ(one.bounds.min, other.bounds.min);
    EXPECT_EQ(one.bounds.max, other.bounds.max);
    EXPECT_EQ(one.triangles, other.triangles);
    ASSERT_EQ(one.instances.size(), other.instances.size());
    for (std::size_t k = 0; k < one.instances.size(); ++k) {
      EXPECT_EQ(one.instances[k].node, other.instances[k].node);
      EXPECT_EQ(one.instances[k].copy, other.instances[k].copy);
      EXPECT_EQ(one.instances[k].worldFromLocal, other.instances[k].worldFromLocal);
      EXPECT_EQ(one.instances[k].bounds.max, other.instances[k].bounds.max);
    }
    ASSERT_EQ(one.cameras.size(), other.cameras.size());
    for (std::size_t k = 0; k < one.cameras.size(); ++k) {
      EXPECT_EQ(one.cameras[k].eye, other.cameras[k].eye);
      EXPECT_EQ(one.cameras[k].forward, other.cameras[k].forward);
      EXPECT_EQ(one.cameras[k].up, other.cameras[k].up);
    }
    ASSERT_EQ(one.lights.size(), other.lights.size());
    for (std::size_t k = 0; k < one.lights.size(); ++k) EXPECT_EQ(one.lights[k].light, other.lights[k].light);
  }
  EXPECT_EQ(a.positions, b.positions);
}

/// A cube (node 0) that carries a lamp, a camera and, as a child (node 1), another cube that is drawn three times.
testing::GlbBuilder family() {
  testing::GlbBuilder builder = testing::cube();
  builder.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "spot"}, {"spot", json::object()}}};
  builder.json["extensionsUsed"] = {"KHR_lights_punctual", "EXT_mesh_gpu_instancing"};
  builder.add("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 1}, {"zfar", 10}}}});
  json& parent = builder.json["nodes"][0];
  parent["camera"] = 0;
  parent["extensions"]["KHR_lights_punctual"]["light"] = 0;
  parent["translation"] = {1, 2, 3};
  parent["children"] = {1};
  json child{{"mesh", 0}, {"name", "child"}, {"scale", {2, 1, 1}}};
  child["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] =
      builder.addPoints({{0, 0, 0}, {5, 0, 0}, {0, 5, 0}});
  builder.add("nodes", child);
  return builder;
}

TEST(NodePlaces, WhatHangsOnAMovedNodeIsWhereAFileWithThatNodeHasIt) {
  const auto scene = sharedScene(family());
  testing::GlbBuilder authored = family();
  authored.json["nodes"][0]["translation"] = {-4, 0.1, 7};
  authored.json["nodes"][0]["rotation"] = {0.1, 0.7, 0.2, 0.3};
  authored.json["nodes"][0]["scale"] = {1, 3, -0.5};
  authored.json["nodes"][1]["translation"] = {0, 0.3, 0};
  NodeOptions parent = placed(0);
  parent.translation = Vec3{-4, 0.1, 7};
  parent.rotation = {0.1, 0.7, 0.2, 0.3};
  parent.scale = Vec3{1, 3, -0.5};
  expectSame(*posed(scene, {parent, movedTo("child", {0, 0.3, 0})}), *sharedScene(authored));
}

TEST(NodePlaces, AMatrixReplacesAllAndPartsReplaceAMatrix) {
  const json matrix = {0, 2, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 9, 8, 7, 1};
  testing::GlbBuilder authored = family();
  authored.json["nodes"][0].erase("translation");
  authored.json["nodes"][0]["matrix"] = matrix;
  NodeOptions entry = placed(0);
  entry.matrix = matrix.get<std::array<double, 16>>();
  expectSame(*posed(sharedScene(family()), {entry}), *sharedScene(authored));

  testing::GlbBuilder parts = family();
  parts.json["nodes"][0]["translation"] = {0, 1, 0};
  expectSame(*posed(sharedScene(authored), {movedTo(0, {0, 1, 0})}), *sharedScene(parts));
  expectSame(*posed(sharedScene(family()), {entry, movedTo(0, {0, 1, 0})}), *sharedScene(parts));
  expectSame(*posed(sharedScene(family()), {movedTo(0, {0, 1, 0}), entry}), *sharedScene(authored));
}

TEST(NodePlaces, OfTwoEntriesForANodeTheLaterCountsPartByPart) {
  NodeOptions wide = placed(0);
  wide.scale = Vec3{3, 1, 1};
  testing::GlbBuilder authored = family();
  authored.json["nodes"][0]["translation"] = {5, 0, 0};
  authored.json["nodes"][0]["scale"] = {3, 1, 1};
  expectSame(*posed(sharedScene(family()), {movedTo(0, {4, 4, 4}), wide, movedTo(0, {5, 0, 0})}),
             *sharedScene(authored));
}

TEST(NodePlaces, AllNodesOfANameMove) {
  testing::GlbBuilder builder = testing::cube();
  builder.addRoot({{"mesh", 0}});
  for (json& node : builder.json["nodes"]) node["name"] = "both";
  const auto moved = posed(sharedScene(builder), {movedTo("both", {7, 0, 0})});
  ASSERT_EQ(moved->scenes[0].instances.size(), 2u);
  for (const Instance& instance : moved->scenes[0].instances) EXPECT_EQ(instance.bounds.min.x, 6);
}

TEST(NodePlaces, APlaceComesAfterTheAnimation) {
  testing::GlbBuilder builder = testing::cube();
  animate(builder, 0, "translation", {0, 2}, {0, 0, 0, 8, 0, 0}, "VEC3");
  animate(builder, 0, "scale", {0, 2}, {1, 1, 1, 3, 3, 3}, "VEC3");
  AnimationMoment moment;
  moment.index = 0;
  moment.timeSeconds = 1;
  const auto scene = sharedScene(builder);
  const auto moved = posed(scene, {movedTo(0, {0, 5, 0})}, moment);
  EXPECT_EQ(moved->scenes[0].bounds.max, glm::dvec3(2, 7, 2)) << "the animation's scale, and the frame's place";
  EXPECT_EQ(posed(scene, {movedTo(0, {0, 5, 0})})->scenes[0].bounds.max, glm::dvec3(1, 6, 1));
}

/// A cube whose vertices follow node 1, which hangs on node 2.
testing::GlbBuilder skinned() {
  testing::GlbBuilder builder = cubeOnJoint();
  builder.add("nodes", json::object());
  builder.addRoot({{"children", {1}}});
  builder.add("skins", {{"joints", {1}}});
  builder.json["nodes"][0]["skin"] = 0;
  builder.add("meshes", testing::cube().json["meshes"][0]);
  return builder;
}

TEST(NodePlaces, MovedJointsBendTheirSkin) {
  NodeOptions above = placed(2);
  above.rotation = {0, 0, 1, 1};
  NodeOptions joint = movedTo(1, {3, 0, 0});
  joint.scale = Vec3{1, 2, 1};
  testing::GlbBuilder authored = skinned();
  authored.json["nodes"][2]["rotation"] = {0, 0, 1, 1};
  authored.json["nodes"][1]["translation"] = {3, 0, 0};
  authored.json["nodes"][1]["scale"] = {1, 2, 1};
  const auto scene = sharedScene(skinned());
  const auto moved = posed(scene, {above, joint});
  expectSame(*moved, *sharedScene(authored));
  EXPECT_FALSE(moved->positions == scene->positions);
  EXPECT_FALSE(moved->positions.sharesWith(scene->positions));
}

TEST(NodePlaces, ARigidMoveSharesAllVertices) {
  for (const testing::GlbBuilder& builder : {family(), skinned()}) {
    const auto scene = sharedScene(builder);
    const auto moved = posed(scene, {movedTo(0, {1, 1, 1})});
    EXPECT_TRUE(moved->positions.sharesWith(scene->positions));
    EXPECT_TRUE(moved->attributes.sharesWith(scene->attributes));
    EXPECT_TRUE(moved->indices.sharesWith(scene->indices));
    EXPECT_TRUE(moved->welded.sharesWith(scene->welded));
  }
}

TEST(NodePlaces, WhatIsScaledToNothingIsLeftOutAndWhatTheFileHasFlatComesBack) {
  testing::GlbBuilder flat = testing::cube();
  flat.json["nodes"][0]["scale"] = {0, 0, 1};
  const auto scene = sharedScene(flat);
  EXPECT_TRUE(scene->scenes[0].instances.empty());
  NodeOptions entry = placed(0);
  entry.scale = Vec3{1, 2, 1};
  EXPECT_EQ(posed(scene, {entry})->scenes[0].bounds.max, glm::dvec3(1, 2, 1));
  entry.scale = Vec3{0, 1, 0};
  EXPECT_TRUE(posed(sharedScene(testing::cube()), {entry})->scenes[0].instances.empty());
}

TEST(NodePlaces, WhatTheFileHidesStaysHidden) {
  testing::GlbBuilder builder = testing::cube();
  builder.json["extensionsUsed"] = {"KHR_node_visibility"};
  builder.json["nodes"][0]["extensions"]["KHR_node_visibility"]["visible"] = false;
  EXPECT_TRUE(posed(sharedScene(builder), {movedTo(0, {1, 0, 0})})->scenes[0].instances.empty());
}

TEST(NodePlaces, ThePoseIsKeptAndSwitchesMakeNone) {
  const auto scene = sharedScene(family());
  NodeOptions unseen = placed("child");
  unseen.visible = false;
  EXPECT_EQ(posed(scene, {unseen}), scene);
  EXPECT_EQ(posed(scene, {}), scene);
  const auto first = posed(scene, {movedTo(0, {1, 0, 0})});
  EXPECT_NE(first, scene);
  EXPECT_EQ(posed(scene, {movedTo(0, {1, 0, 0})}), first);
  EXPECT_NE(posed(scene, {movedTo(0, {2, 0, 0})}), first);
}

TEST(NodePlaces, ProblemsPointToTheirEntry) {
  const auto scene = sharedScene(family());
  EXPECT_EQ(problemOf(scene, {movedTo(0, {}), movedTo(7, {})}).pointer, "/nodes/1/node");
  EXPECT_EQ(problemOf(scene, {movedTo("chil", {})}).pointer, "/nodes/0/node");
  EXPECT_THAT(problemOf(scene, {movedTo("chil", {})}).limit, HasSubstr("child"));
}

TEST(NodePlaces, WhatIsBeyondReachIsAProblemOfThePlaceThatTakesItThere) {
  testing::GlbBuilder huge = family();
  huge.json["nodes"][1]["scale"] = {1e4, 1, 1};
  NodeOptions entry = placed(0);
  entry.scale = Vec3{1e9, 1, 1};
  NodeOptions other = placed(1);
  other.translation = Vec3{0, 0, 0};
  testing::GlbBuilder beside = huge;
  beside.addRoot({{"name", "bystander"}});
  const Problem problem = problemOf(sharedScene(beside), {movedTo("bystander", {1, 1, 1}), entry});
  EXPECT_EQ(problem.pointer, "/nodes/1");
  EXPECT_EQ(problem.code, ProblemCode::invalidValue);
}

RC_GTEST_PROP(NodePlaces, AnyPlaceIsThatOfAFileWithThatNode, ()) {
  const auto number = [] { return *rc::gen::inRange(-1000, 1001) / 64.0; };
  const auto three = [&] { return Vec3{number(), number(), number()}; };
  testing::GlbBuilder authored = family();
  NodeOptions entry = placed(*rc::gen::inRange(0, 2));
  json& node = authored.json["nodes"][static_cast<std::size_t>(std::get<int>(*entry.node))];
  if (*rc::gen::arbitrary<bool>()) node["translation"] = *(entry.translation = three());
  if (*rc::gen::arbitrary<bool>()) node["scale"] = *(entry.scale = three());
  if (*rc::gen::arbitrary<bool>()) node["rotation"] = *(entry.rotation = {number(), number(), number(), 1});
  expectSame(*posed(sharedScene(family()), {entry}), *sharedScene(authored));
}

} // namespace
} // namespace gnomon
