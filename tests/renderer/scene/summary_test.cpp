#include "renderer/scene/summary.h"

#include "tests/renderer/scene/load.h"

namespace gnomon {
namespace {

using nlohmann::json;
using ::testing::ElementsAre;

/// A cube on a skin of two joints, with two morph targets; the node and its joints in scene 0.
testing::GlbBuilder deformedCube() {
  testing::GlbBuilder builder = testing::cube();
  const std::vector<std::uint16_t> joints(std::size_t{24} * 4, 0);
  std::vector<float> weights(std::size_t{24} * 4, 0);
  for (std::size_t i = 0; i < 24; ++i) weights[4 * i] = 1;
  json& primitive = builder.json["meshes"][0]["primitives"][0];
  primitive["attributes"]["JOINTS_0"] = builder.addAccessor(joints, "VEC4", 5123, 24);
  primitive["attributes"]["WEIGHTS_0"] = builder.addAccessor(weights, "VEC4", 5126, 24);
  const int moves = builder.addPoints(std::vector<testing::Point>(24, {0, 1, 0}));
  primitive["targets"] = {{{"POSITION", moves}}, {{"POSITION", moves}}};
  builder.addRoot({{"children", {2}}});
  builder.add("nodes", json::object());
  builder.add("skins", {{"joints", {1, 2}}});
  builder.json["nodes"][0]["skin"] = 0;
  return builder;
}

std::uint64_t sumOf(const MemorySummary& memory) {
  return memory.vertices + memory.indices + memory.images + memory.volumes + memory.deformation + memory.animations +
         memory.structure;
}

TEST(Summary, MemoryByPartAddsUp) {
  const SceneSummary cube = load(testing::cube()).summary;
  EXPECT_EQ(cube.memory.vertices, 24 * (sizeof(glm::vec3) + sizeof(VertexAttributes)));
  EXPECT_GE(cube.memory.indices, 36 * sizeof(std::uint32_t));
  EXPECT_EQ(cube.memory.images, 0u);
  EXPECT_EQ(cube.memory.deformation, 0u);
  EXPECT_GT(cube.memory.structure, 0u);
  EXPECT_EQ(cube.memoryBytes, sumOf(cube.memory));

  const SceneSummary deformed = load(deformedCube()).summary;
  EXPECT_GT(deformed.memory.deformation, cube.memory.vertices);
  EXPECT_EQ(deformed.memoryBytes, sumOf(deformed.memory));
}

TEST(Summary, G3_CountsWhatDeforms) {
  const SceneSummary summary = load(deformedCube()).summary;
  EXPECT_EQ(summary.skins, 1u);
  EXPECT_EQ(summary.joints, 2u);
  EXPECT_EQ(summary.morphTargets, 2u);
}

TEST(Summary, CountsDeformedMeshesOfTheDefaultSceneOnly) {
  testing::GlbBuilder builder = deformedCube();
  builder.json["scenes"].push_back({{"nodes", {1}}});
  builder.json["scene"] = 1;
  const SceneSummary summary = load(builder).summary;
  EXPECT_EQ(summary.nodes, 2u);
  EXPECT_EQ(summary.instances + summary.skins + summary.joints + summary.morphTargets, 0u);
}

TEST(Summary, EachPrimitiveIsAnInstanceOfItsOwn) {
  testing::GlbBuilder builder = testing::cube();
  json& primitives = builder.json["meshes"][0]["primitives"];
  primitives.push_back(primitives[0]);
  builder.addMeshNode(0);
  const SceneSummary summary = load(builder).summary;
  EXPECT_EQ(summary.meshes, 1u);
  EXPECT_EQ(summary.instances, 4u);
}

TEST(Summary, NamesTheExtensionsThatAreIgnored) {
  testing::GlbBuilder builder = testing::cube();
  builder.json["extensionsUsed"] = {"ACME_b", "KHR_lights_punctual", "ACME_a"};
  const SceneSummary summary = load(builder).summary;
  EXPECT_THAT(summary.extensionsUsed, ElementsAre("ACME_b", "KHR_lights_punctual", "ACME_a"));
  EXPECT_THAT(summary.extensionsIgnored, ElementsAre("ACME_b", "ACME_a"));
  EXPECT_EQ(summary.warnings.size(), 2u);
}

} // namespace
} // namespace gnomon
