#include "renderer/scene/posing/pose.h"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <numbers>

#include "tests/renderer/scene/geometry.h"
#include "tests/renderer/scene/load.h"
#include "tests/renderer/scene/posing/placed_vertices.h"

namespace gnomon {
namespace {

using nlohmann::json;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// An arm along Y, bent at y = 1: the lower joint is node 1, the upper, its child, node 2; the mesh hangs on node 0.
struct Arm {
  std::vector<glm::vec3> positions;
  std::vector<float> upper; ///< how much of each vertex follows the upper joint
  testing::GlbBuilder builder;
};

enum class WeightType { floats, bytes };

/// `sets`: 1 = four joints a vertex, 2 = eight, half of each weight in each set.
Arm bentArm(int sets = 1, WeightType type = WeightType::floats) {
  Arm arm;
  std::vector<glm::vec3> normals;
  for (int i = 0; i <= 8; ++i) {
    for (const float x : {-0.5f, 0.5f}) {
      arm.positions.emplace_back(x, 0.25f * static_cast<float>(i), 0.125f * x);
      normals.emplace_back(0, 0, 1);
      arm.upper.push_back(std::min(1.0f, static_cast<float>(i) / 5));
    }
  }
  std::vector<std::uint32_t> indices;
  for (std::uint32_t i = 0; i < 16; i += 2) indices.insert(indices.end(), {i, i + 1, i + 2, i + 1, i + 3, i + 2});
  testing::GlbBuilder& builder = arm.builder;
  const std::size_t count = arm.positions.size();
  json attributes = {{"POSITION", builder.addAccessor(arm.positions, "VEC3", 5126, count)},
                     {"NORMAL", builder.addAccessor(normals, "VEC3", 5126, count)}};
  for (int set = 0; set < sets; ++set) {
    std::vector<std::uint16_t> joints;
    std::vector<float> floats;
    std::vector<std::uint8_t> bytes;
    for (const float upper : arm.upper) {
      joints.insert(joints.end(), {1, 0, 0, 0});
      const float whole = 1.0f / static_cast<float>(sets);
      floats.insert(floats.end(), {upper * whole, (1 - upper) * whole, 0, 0});
      const auto byte = static_cast<std::uint8_t>(std::lround(upper * 255));
      bytes.insert(bytes.end(), {byte, static_cast<std::uint8_t>(255 - byte), 0, 0});
    }
    const std::string number = std::to_string(set);
    attributes["JOINTS_" + number] = builder.addAccessor(joints, "VEC4", 5123, count);
    attributes["WEIGHTS_" + number] = type == WeightType::floats
                                          ? builder.addAccessor(floats, "VEC4", 5126, count)
                                          : builder.addAccessor(bytes, "VEC4", 5121, count, true);
  }
  builder.addMeshNode(builder.addMesh({{"attributes", attributes}, {"indices", builder.addIndices(indices)}}));
  const std::vector<glm::mat4> inverseBind{glm::mat4(1), glm::translate(glm::mat4(1), glm::vec3(0, -1, 0))};
  builder.addRoot({{"translation", {10, 0, 0}}, {"children", {2}}});
  builder.add("nodes", {{"translation", {0, 1, 0}}, {"rotation", kQuarterAroundZ}});
  builder.add("skins",
              {{"joints", {1, 2}}, {"inverseBindMatrices", builder.addAccessor(inverseBind, "MAT4", 5126, 2)}});
  builder.json["nodes"][0]["skin"] = 0;
  builder.json["nodes"][0]["translation"] = {77, 88, 99}; // means nothing
  return arm;
}

/// The arm bent by hand: the lower part moves by (10, 0, 0), the upper turns by 90 degrees around (10, 1, 0) besides,
/// and what follows both lies between.
void expectBent(const Arm& arm, const std::vector<Placed>& placed, double tolerance = 1e-6) {
  for (std::size_t i = 0; i < arm.positions.size(); ++i) {
    const glm::dvec3 p(arm.positions[i]);
    const glm::dvec3 lower(p.x + 10, p.y, p.z);
    const glm::dvec3 upper(10 - (p.y - 1), 1 + p.x, p.z);
    expectNear(placed[i].position, glm::mix(lower, upper, static_cast<double>(arm.upper[i])), tolerance);
  }
}

TEST(Pose, G3_SkinsAreBentByTheirJointsAndTheBoundsFollow) {
  for (const int sets : {1, 2}) {
    const Arm arm = bentArm(sets);
    const Scene scene = load(arm.builder);
    ASSERT_EQ(scene.scenes[0].instances.size(), 1u);
    EXPECT_THAT(scene.summary.warnings, IsEmpty());
    expectBent(arm, placedVertices(scene, arm.positions.size()));
    Aabb box;
    for (const Placed& vertex : placedVertices(scene, arm.positions.size())) box.add(vertex.position);
    expectNear(scene.scenes[0].bounds.min, box.min, 1e-6);
    expectNear(scene.scenes[0].bounds.max, box.max, 1e-6);
    expectNear(glm::dvec3(scene.summary.boundsMin[0], scene.summary.boundsMin[1], scene.summary.boundsMin[2]), box.min,
               1e-6);
  }
}

TEST(Pose, WeightsMayBeNormalizedIntegers) {
  const Arm arm = bentArm(1, WeightType::bytes);
  expectBent(arm, placedVertices(load(arm.builder), arm.positions.size()), 1e-5);
}

TEST(Pose, WeightsAreScaledToOne) {
  Arm arm = bentArm(2);
  json& attributes = arm.builder.json["meshes"][0]["primitives"][0]["attributes"];
  attributes.erase("JOINTS_1"); // what is left sums to a half
  attributes.erase("WEIGHTS_1");
  expectBent(arm, placedVertices(load(arm.builder), arm.positions.size()));
}

TEST(Pose, NormalsTurnWithTheSurface) {
  Arm arm = bentArm();
  arm.builder.json["nodes"][2]["rotation"] = kQuarterAroundY;
  arm.builder.json["nodes"][2]["scale"] = {1, 1, 4};
  const std::vector<Placed> placed = placedVertices(load(arm.builder), arm.positions.size());
  expectNear(placed.front().normal, {0, 0, 1}, 1e-6);
  expectNear(placed.back().normal, {1, 0, 0}, 1e-6);
}

TEST(Pose, TheFirstJointMayMirror) {
  Arm arm = bentArm();
  arm.builder.json["nodes"][1]["scale"] = {-1, 1, 1};
  const Scene scene = load(arm.builder);
  EXPECT_LT(glm::determinant(glm::dmat3(scene.scenes[0].instances[0].worldFromLocal)), 0) << "front faces turn over";
  const std::vector<Placed> placed = placedVertices(scene, arm.positions.size());
  for (std::size_t i = 0; i < 2; ++i) {
    expectNear(placed[i].position, glm::dvec3(10, 0, 0) + glm::dvec3(-1, 1, 1) * glm::dvec3(arm.positions[i]), 1e-6);
  }
}

TEST(Pose, APlaceFarAwayCostsNoDigits) {
  const Arm near = bentArm();
  Arm far = bentArm();
  far.builder.json["nodes"][1]["translation"] = {1e7, 0, 0};
  EXPECT_EQ(load(near.builder).positions, load(far.builder).positions);
}

TEST(Pose, ASkinnedMeshWithoutASkinFollowsItsNode) {
  Arm arm = bentArm();
  arm.builder.json["nodes"][0].erase("skin");
  const std::vector<Placed> placed = placedVertices(load(arm.builder), arm.positions.size());
  expectNear(placed[0].position, glm::dvec3(arm.positions[0]) + glm::dvec3(77, 88, 99), 1e-4);
}

TEST(Skins, HoldsJointsAndMatricesAgainstEachOther) {
  const std::string attributes = "/meshes/0/primitives/0/attributes";
  expectTold(bentArm().builder, {{"/skins/0/joints", json::array({1}), "/nodes/0/skin"},
                                 {"/skins/0/joints", {0, 1, 2}, "/skins/0/inverseBindMatrices"},
                                 {"/skins/0/inverseBindMatrices", 0, "/skins/0/inverseBindMatrices"},
                                 {"/skins/0/joints", json::array(), "/skins/0/joints"},
                                 {attributes + "/WEIGHTS_0", nullptr, attributes + "/JOINTS_0"}});
  expectBeyond(bentArm().builder, &Limits::maxJoints, 1, "/skins/0/joints");
}

/// A triangle whose first target lifts its second vertex by 2, and whose second turns all normals.
testing::GlbBuilder morphing() {
  testing::GlbBuilder builder;
  const int position = builder.addPoints({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  const int normal = builder.addPoints({{0, 0, 1}, {0, 0, 1}, {0, 0, 1}});
  const int lift = builder.addPoints({{0, 0, 0}, {0, 0, 2}, {0, 0, 0}});
  const int turn = builder.addPoints({{1, 0, -1}, {1, 0, -1}, {1, 0, -1}});
  json primitive = {{"attributes", {{"POSITION", position}, {"NORMAL", normal}}}};
  primitive["targets"] = {{{"POSITION", lift}}, {{"NORMAL", turn}}};
  builder.addMeshNode(builder.addMesh(primitive));
  return builder;
}

TEST(Pose, G3_MorphTargetsMoveByTheirDefaultWeights) {
  testing::GlbBuilder builder = morphing();
  EXPECT_EQ(load(builder).scenes[0].bounds.max.z, 0) << "without weights, all are 0";
  builder.json["meshes"][0]["weights"] = {0.25, 1};
  Scene scene = load(builder);
  EXPECT_EQ(scene.scenes[0].bounds.max.z, 0.5);
  expectNear(placedVertices(scene, 3)[0].normal, {1, 0, 0}, 1e-6);
  builder.json["nodes"][0]["weights"] = {-1, 0};
  scene = load(builder);
  EXPECT_EQ(scene.scenes[0].bounds.min.z, -2) << "the node's own come first";
  EXPECT_EQ(scene.clusters[0].bounds.min.z, -2);
  expectNear(placedVertices(scene, 3)[0].normal, {0, 0, 1}, 1e-6);
}

TEST(Pose, NodesThatCanNotDifferShareTheirVertices) {
  testing::GlbBuilder builder = morphing();
  builder.addMeshNode(0);
  builder.addMeshNode(0);
  builder.json["nodes"][2]["weights"] = {1, 0};
  EXPECT_EQ(load(builder).positions.size(), 6u);
  EXPECT_EQ(load(builder).summary.triangles, 3u);
  const int times = builder.addAccessor(std::vector<float>{0, 1}, "SCALAR", 5126, 2);
  const int values = builder.addAccessor(std::vector<float>{0, 0, 1, 1}, "SCALAR", 5126, 4);
  builder.add("animations", {{"samplers", {{{"input", times}, {"output", values}}}},
                             {"channels", {{{"sampler", 0}, {"target", {{"node", 1}, {"path", "weights"}}}}}}});
  EXPECT_EQ(load(builder).positions.size(), 9u);
}

TEST(Pose, FlatNormalsFollowTheMorphedTriangle) {
  testing::GlbBuilder builder = morphing();
  builder.json["meshes"][0]["primitives"][0]["attributes"].erase("NORMAL");
  builder.json["meshes"][0]["weights"] = {0.5, 0};
  for (const Placed& vertex : placedVertices(load(builder), 3)) {
    expectNear(vertex.normal, glm::normalize(glm::dvec3(-1, 0, 1)), 1e-6);
  }
}

TEST(Pose, ATriangleMayGrowFromNothing) {
  testing::GlbBuilder builder = morphing();
  builder.json["meshes"][0]["primitives"][0]["attributes"] = {
      {"POSITION", builder.addPoints({{0, 0, 0}, {0, 0, 0}, {0, 1, 0}})}};
  for (const Placed& vertex : placedVertices(load(builder), 3)) EXPECT_EQ(glm::length(vertex.normal), 1);
  builder.json["meshes"][0]["weights"] = {1, 0};
  EXPECT_EQ(load(builder).scenes[0].bounds.max.z, 2);
}

TEST(MorphTargets, AreHeldAgainstTheirMeshAndTheLimits) {
  const std::string targets = "/meshes/0/primitives/0/targets";
  testing::GlbBuilder builder = morphing();
  const int one = builder.addPoints({{0, 0, 0}});
  const int infinite = builder.addPoints({{0, 0, 0}, {0, std::numeric_limits<float>::infinity(), 0}, {0, 0, 0}});
  json fewer = builder.json["meshes"][0]["primitives"][0];
  fewer["targets"].erase(1);
  expectTold(builder, {{"/meshes/0/weights", json::array({1}), "/meshes/0/weights"},
                       {"/nodes/0/weights", {1, 2, 3}, "/nodes/0/weights"},
                       {targets + "/1/NORMAL", one, targets + "/1/NORMAL"},
                       {"/meshes/0/primitives/1", fewer, "/meshes/0/primitives/1/targets"},
                       {targets + "/0/POSITION", infinite, targets + "/0"}});
  expectBeyond(morphing(), &Limits::maxMorphTargets, 1, targets);
  expectLimit(morphing(), &Limits::maxMorphedVertices, 6, targets);

  builder = morphing();
  for (int i = 1; i < 4; ++i) builder.addRoot({{"mesh", 0}, {"weights", {0.1 * i, 0}}});
  expectLimit(builder, &Limits::maxVertices, 12, "/nodes/3/mesh");
  expectBeyond(builder, &Limits::maxTriangles, 3, "/nodes/3/mesh");
  expectBeyond(builder, &Limits::maxMorphedVertices, 15, "/nodes/3/mesh");
}

} // namespace
} // namespace gnomon
