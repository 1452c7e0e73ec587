#include "renderer/scene/animation/posed_scene.h"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include "tests/renderer/scene/animation/animated.h"
#include "tests/renderer/scene/geometry.h"
#include "tests/renderer/scene/load.h"
#include "tests/renderer/scene/posing/placed_vertices.h"

namespace gnomon {
namespace {

using nlohmann::json;
using ::testing::ElementsAre;

AnimationMoment at(double seconds) {
  AnimationMoment moment;
  moment.index = 0;
  moment.timeSeconds = seconds;
  return moment;
}

std::shared_ptr<const Scene> posedAt(const std::shared_ptr<const Scene>& scene, double seconds) {
  const auto posed = posedScene(scene, {at(seconds)});
  if (posed) return *posed;
  ADD_FAILURE() << posed.problems().front().detail;
  return scene;
}

/// A cube that flies from the origin to (8, 0, 4) within two seconds, on a node that also turns below its parent.
testing::GlbBuilder flyingCube() {
  testing::GlbBuilder builder = testing::cube();
  animate(builder, 0, "translation", {1, 3}, {0, 0, 0, 8, 0, 4}, "VEC3");
  return builder;
}

TEST(PosedScene, InstancesAndBoundsFollowTheirNode) {
  const auto scene = sharedScene(flyingCube());
  const SceneView& view = posedAt(scene, 1.5)->scenes[0];
  EXPECT_EQ(view.bounds.min, glm::dvec3(1, -1, 0));
  EXPECT_EQ(view.bounds.max, glm::dvec3(3, 1, 2));
  EXPECT_EQ(view.instances[0].bounds.min, view.bounds.min);
  EXPECT_EQ(view.triangles, scene->scenes[0].triangles);
  EXPECT_EQ(scene->scenes[0].bounds.max, glm::dvec3(1)) << "the loaded scene stays as it is";
}

TEST(PosedScene, BeyondItsEndsAnAnimationStandsStill) {
  const auto scene = sharedScene(flyingCube());
  EXPECT_EQ(posedAt(scene, -5)->scenes[0].bounds.max, glm::dvec3(1));
  EXPECT_EQ(posedAt(scene, 1)->scenes[0].bounds.max, glm::dvec3(1));
  EXPECT_EQ(posedAt(scene, 3)->scenes[0].bounds.max, glm::dvec3(9, 1, 5));
  EXPECT_EQ(posedAt(scene, 99), posedAt(scene, 3)) << "all times past the end are one pose";
}

TEST(PosedScene, ChildrenFollowAndTurn) {
  testing::GlbBuilder builder = testing::cube();
  builder.json["nodes"][0]["translation"] = {2, 0, 0};
  builder.json["scenes"][0]["nodes"] = {1};
  builder.add("nodes", {{"children", {0}}});
  const auto half = static_cast<float>(std::numbers::sqrt2 / 2);
  animate(builder, 1, "rotation", {0, 1}, {0, 0, 0, 1, 0, 0, half, half}, "VEC4"); // a quarter around Z
  const auto scene = sharedScene(builder);
  const glm::dmat4& place = posedAt(scene, 0.5)->scenes[0].instances[0].worldFromLocal;
  const double s = std::sqrt(0.5);
  expectNear(glm::dvec3(place[3]), {2 * s, 2 * s, 0}, 1e-6);
  expectNear(glm::dvec3(place[0]), {s, s, 0}, 1e-6);
}

TEST(PosedScene, WhatIsScaledToNothingAtRestAppearsInItsTime) {
  testing::GlbBuilder builder = testing::cube();
  builder.json["nodes"][0]["scale"] = {0, 0, 0};
  animate(builder, 0, "scale", {0, 1}, {0, 0, 0, 2, 2, 2}, "VEC3");
  const auto scene = sharedScene(builder);
  EXPECT_TRUE(scene->scenes[0].instances.empty());
  EXPECT_TRUE(posedAt(scene, 0)->scenes[0].instances.empty());
  EXPECT_EQ(posedAt(scene, 0.75)->scenes[0].bounds.max, glm::dvec3(1.5));
}

TEST(PosedScene, CamerasAndLightsRideOnTheirNodes) {
  testing::GlbBuilder builder = testing::cube();
  builder.add("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 1}}}});
  builder.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "spot"}, {"spot", json::object()}}};
  builder.addRoot({{"camera", 0}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  animate(builder, 1, "translation", {0, 1}, {0, 0, 9, 4, 0, 9}, "VEC3");
  const auto half = static_cast<float>(std::numbers::sqrt2 / 2);
  animate(builder, 1, "rotation", {0, 1}, {0, 0, 0, 1, 0, half, 0, half}, "VEC4");
  const auto posed = posedAt(sharedScene(builder), 1);
  const SceneView& view = posed->scenes[0];
  expectNear(view.cameras.at(0).eye, {4, 0, 9});
  expectNear(view.cameras.at(0).forward, {-1, 0, 0}, 1e-6);
  expectNear(toDvec3(*view.lights.at(0).light.position), {4, 0, 9});
  expectNear(toDvec3(*view.lights.at(0).light.direction), {-1, 0, 0}, 1e-6);
}

TEST(PosedScene, WeightsMoveMorphTargets) {
  testing::GlbBuilder builder = testing::cube();
  const std::size_t vertices = builder.json["accessors"][0]["count"];
  const int target = builder.addPoints(std::vector<testing::Point>(vertices, {0, 6, 0}));
  const int other = builder.addPoints(std::vector<testing::Point>(vertices, {0, 0, 2}));
  builder.json["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", target}}, {{"POSITION", other}}};
  animate(builder, 0, "weights", {0, 2}, {0, 1, 1, 1}, "SCALAR");
  const auto scene = sharedScene(builder);
  EXPECT_EQ(scene->scenes[0].bounds.max, glm::dvec3(1)) << "the file's own weights are 0";
  EXPECT_EQ(posedAt(scene, 0.5)->scenes[0].bounds.min, glm::dvec3(-1, 0.5, 1));
  EXPECT_EQ(posedAt(scene, 0.5)->scenes[0].bounds.max, glm::dvec3(1, 2.5, 3));
}

/// A strip along Y of which each vertex follows two joints; the pose is computed here from the joints' matrices.
TEST(PosedScene, SkinnedVerticesStandWhereTheirJointsTakeThem) {
  testing::GlbBuilder builder;
  std::vector<glm::vec3> positions;
  std::vector<std::uint16_t> joints;
  std::vector<float> weights;
  for (int i = 0; i <= 8; ++i) {
    for (const float x : {-0.5f, 0.5f}) {
      positions.emplace_back(x, 0.25f * static_cast<float>(i), 0.125f * x);
      const float upper = static_cast<float>(i) / 8;
      joints.insert(joints.end(), {0, 1, 0, 0});
      weights.insert(weights.end(), {1 - upper, upper, 0, 0});
    }
  }
  std::vector<std::uint32_t> indices;
  for (std::uint32_t i = 0; i < 16; i += 2) indices.insert(indices.end(), {i, i + 1, i + 2, i + 1, i + 3, i + 2});
  const std::size_t count = positions.size();
  builder.addMeshNode(builder.addMesh({{"attributes",
                                        {{"POSITION", builder.addAccessor(positions, "VEC3", 5126, count)},
                                         {"JOINTS_0", builder.addAccessor(joints, "VEC4", 5123, count)},
                                         {"WEIGHTS_0", builder.addAccessor(weights, "VEC4", 5126, count)}}},
                                       {"indices", builder.addIndices(indices)}}));
  const std::vector<glm::mat4> inverseBind{glm::mat4(1), glm::translate(glm::mat4(1), glm::vec3(0, -1, 0))};
  builder.addRoot({{"translation", {10, 0, 0}}, {"children", {2}}});
  builder.add("nodes", {{"translation", {0, 1, 0}}});
  builder.add("skins",
              {{"joints", {1, 2}}, {"inverseBindMatrices", builder.addAccessor(inverseBind, "MAT4", 5126, 2)}});
  builder.json["nodes"][0]["skin"] = 0;
  const double angle = 1.2;
  animate(builder, 2, "rotation", {0, 1},
          {0, 0, 0, 1, 0, 0, static_cast<float>(std::sin(angle / 2)), static_cast<float>(std::cos(angle / 2))}, "VEC4");
  animate(builder, 1, "translation", {0, 1}, {10, 0, 0, 10, 0, 6}, "VEC3");

  const double share = 0.25;
  const auto posed = posedAt(sharedScene(builder), share);
  const glm::dmat4 lower = glm::translate(glm::dmat4(1), glm::dvec3(10, 0, 6 * share));
  const glm::dmat4 upper = lower * glm::translate(glm::dmat4(1), glm::dvec3(0, 1, 0)) *
                           glm::rotate(glm::dmat4(1), angle * share, glm::dvec3(0, 0, 1)) *
                           glm::translate(glm::dmat4(1), glm::dvec3(0, -1, 0));
  const TriangleMesh& mesh = posed->deformation->deformables.front().mesh;
  const Primitive& primitive = posed->primitives.front();
  ASSERT_GT(primitive.vertexCount, 0u);
  const SceneView& view = posed->scenes[0];
  for (std::size_t i = 0; i < primitive.vertexCount; ++i) {
    const glm::dvec4 rest(glm::dvec3(positions[mesh.sources[i]]), 1);
    const double weight = double(mesh.sources[i] / 2) / 8;
    const glm::dvec3 expected(weight * (upper * rest) + (1 - weight) * (lower * rest));
    const glm::dvec4 local(glm::dvec3(posed->positions[primitive.baseVertex + i]), 1);
    const glm::dvec3 actual(view.instances.front().worldFromLocal * local);
    expectNear(actual, expected, 1e-5);
    EXPECT_LT(std::sqrt(squaredDistance(view.bounds, expected)), 1e-5);
  }
}

TEST(PosedScene, ThePoseThatWasAskedForIsKept) {
  const auto scene = sharedScene(flyingCube());
  const auto first = posedAt(scene, 1.5);
  EXPECT_EQ(posedAt(scene, 1.5), first);
  EXPECT_NE(posedAt(scene, 1.75), first);
  EXPECT_EQ(posedAt(scene, 1.5), first);
}

TEST(PosedScene, WithoutAnAnimationItIsTheSceneItself) {
  const auto scene = sharedScene(flyingCube());
  EXPECT_EQ(*posedScene(scene, {}), scene);
  EXPECT_EQ(*posedScene(scene, {AnimationMoment{}}), scene);
}

TEST(PosedScene, UnknownAnimationsAreToldWithThoseThereAre) {
  const auto scene = sharedScene(flyingCube());
  AnimationMoment moment;
  moment.index = 1;
  const auto byIndex = posedScene(scene, {moment});
  ASSERT_FALSE(byIndex);
  EXPECT_THAT(byIndex.problems(), ElementsAre(ProblemAt(ProblemCode::invalidValue, "/animation/index")));
  EXPECT_EQ(byIndex.problems()[0].limit, "0..0");
  moment.index.reset();
  moment.name = "Moov";
  const auto byName = posedScene(scene, {moment});
  ASSERT_FALSE(byName);
  EXPECT_THAT(byName.problems(), ElementsAre(ProblemAt(ProblemCode::invalidValue, "/animation/name")));
  EXPECT_EQ(byName.problems()[0].limit, "\"Move\"");
  moment.name = "Move";
  EXPECT_TRUE(posedScene(scene, {moment}));
  EXPECT_FALSE(posedScene(sharedScene(testing::cube()), {moment})) << "a scene without animations";
}

TEST(PosedScene, APlaceBeyondReachIsAProblem) {
  for (const float far : {3e9f, 3e38f}) {
    testing::GlbBuilder builder = testing::cube();
    builder.json["nodes"][0]["name"] = "far";
    builder.json["scenes"][0]["nodes"] = {1};
    builder.add("nodes", {{"children", {0}}});
    animate(builder, 1, "scale", {0, 1}, {1, 1, 1, far, 1, 1}, "VEC3");
    const auto scene = sharedScene(builder);
    EXPECT_TRUE(posedScene(scene, {at(0)}));
    const auto lost = posedScene(scene, {at(1)});
    ASSERT_FALSE(lost);
    EXPECT_EQ(lost.problems()[0].pointer, "/animation");
    EXPECT_THAT(lost.problems()[0].actual, ::testing::HasSubstr("node 1"));
  }
}

TEST(PosedScene, VerticesBeyondReachAreAProblem) {
  testing::GlbBuilder builder = testing::cube();
  std::vector<testing::Point> moves(24, testing::Point{0, 0, 0});
  moves[3] = {0, 3e9f, 0};
  builder.json["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", builder.addPoints(moves)}}};
  builder.json["meshes"][0]["weights"] = {0};
  animate(builder, 0, "weights", {0, 1}, {0, 1}, "SCALAR");
  const auto scene = sharedScene(builder);
  EXPECT_TRUE(posedScene(scene, {at(0.25)}));
  const auto lost = posedScene(scene, {at(1)});
  ASSERT_FALSE(lost);
  EXPECT_EQ(lost.problems()[0].pointer, "/animation");
}

} // namespace
} // namespace gnomon
