// Morph targets, and what a node's copy of them comes to.
#include <limits>

#include "tests/renderer/scene/geometry.h"
#include "tests/renderer/scene/load.h"
#include "tests/renderer/scene/posing/placed_vertices.h"

namespace gnomon {
namespace {

using nlohmann::json;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

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
  builder.json["meshes"][0]["weights"] = {1};
  EXPECT_THAT(findingsOf(builder), ::testing::HasSubstr("/meshes/0/weights"));
  builder = morphing();
  builder.json["nodes"][0]["weights"] = {1, 2, 3};
  EXPECT_THAT(findingsOf(builder), ::testing::HasSubstr("/nodes/0/weights"));
  builder = morphing();
  builder.json["meshes"][0]["primitives"][0]["targets"][1]["NORMAL"] = builder.addPoints({{0, 0, 0}});
  EXPECT_THAT(findingsOf(builder), ::testing::HasSubstr(targets + "/1/NORMAL"));
  builder = morphing();
  json second = builder.json["meshes"][0]["primitives"][0];
  second["targets"].erase(1);
  builder.json["meshes"][0]["primitives"].push_back(second);
  EXPECT_THAT(findingsOf(builder), ::testing::HasSubstr("/meshes/0/primitives/1/targets"));
  builder = morphing();
  const float infinite = std::numeric_limits<float>::infinity();
  builder.json["meshes"][0]["primitives"][0]["targets"][0]["POSITION"] =
      builder.addPoints({{0, 0, 0}, {0, infinite, 0}, {0, 0, 0}});
  EXPECT_THAT(findingsOf(builder), ::testing::HasSubstr(targets + "/0"));

  Limits limits;
  limits.maxMorphTargets = 1;
  EXPECT_THAT(problemsOf(morphing(), limits), ElementsAre(ProblemAt(ProblemCode::tooLarge, targets)));
  limits = {};
  limits.maxMorphedVertices = 6;
  EXPECT_THAT(problemsOf(morphing(), limits), IsEmpty());
  limits.maxMorphedVertices = 5;
  EXPECT_THAT(problemsOf(morphing(), limits), ElementsAre(ProblemAt(ProblemCode::tooLarge, targets)));

  builder = morphing();
  for (int i = 1; i < 4; ++i) builder.addRoot({{"mesh", 0}, {"weights", {0.1 * i, 0}}});
  limits = {};
  limits.maxVertices = 12;
  EXPECT_THAT(problemsOf(builder, limits), IsEmpty());
  limits.maxVertices = 11;
  EXPECT_THAT(problemsOf(builder, limits), ElementsAre(ProblemAt(ProblemCode::tooLarge, "/nodes/3/mesh")));
  limits = {};
  limits.maxTriangles = 3;
  EXPECT_THAT(problemsOf(builder, limits), ElementsAre(ProblemAt(ProblemCode::tooLarge, "/nodes/3/mesh")));
  limits = {};
  limits.maxMorphedVertices = 15;
  EXPECT_THAT(problemsOf(builder, limits), ElementsAre(ProblemAt(ProblemCode::tooLarge, "/nodes/3/mesh")));
}

} // namespace
} // namespace gnomon
