#include "renderer/scene/summary.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "renderer/scene/findings.h"
#include "renderer/scene/found_nodes.h"
#include "tests/renderer/scene/load.h"

namespace gnomon {
namespace {

using nlohmann::json;
using ::testing::ElementsAre;

/// A cube on a skin of two joints, with two morph targets; the node and its joints in scene 0.
testing::GlbBuilder deformedCube() {
  testing::GlbBuilder builder = cubeOnJoint();
  json& primitive = builder.json["meshes"][0]["primitives"][0];
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
  EXPECT_EQ(cube.memory.vertices, (24 + 4) * (sizeof(glm::vec3) + sizeof(VertexAttributes))) << "and a ground's";
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

/// A cube at node 0, and a node below it with the same mesh.
testing::GlbBuilder cubeOnCube() {
  testing::GlbBuilder builder = testing::cube();
  builder.json["nodes"][0]["name"] = "base";
  builder.json["nodes"][0]["children"] = {1};
  builder.add("nodes", {{"name", "top"}, {"mesh", 0}, {"translation", {0, 1, 0}}});
  return builder;
}

TEST(NodeList, NamesParentsAndTriangles) {
  const NodeList list = nodesOf(load(cubeOnCube()), {});
  ASSERT_EQ(list.nodes.size(), 2u);
  EXPECT_FALSE(list.next);
  EXPECT_EQ(list.nodes[0].name, "base");
  EXPECT_FALSE(list.nodes[0].parent);
  EXPECT_EQ(list.nodes[0].triangles, 12u);
  EXPECT_EQ(list.nodes[1].node, 1);
  EXPECT_EQ(list.nodes[1].parent, 0);
  EXPECT_EQ(list.nodes[1].triangles, 12u);
}

TEST(NodeList, PagesHaveEveryNodeOnce) {
  const Scene& scene = load(cubeOnCube());
  const NodeList first = nodesOf(scene, {.limit = 1});
  ASSERT_EQ(first.nodes.size(), 1u);
  ASSERT_EQ(first.next, 0);
  const NodeList second = nodesOf(scene, {.after = *first.next, .limit = 1});
  ASSERT_EQ(second.nodes.size(), 1u);
  EXPECT_EQ(second.nodes[0].node, 1);
  EXPECT_FALSE(second.next);
  EXPECT_TRUE(nodesOf(scene, {.after = 99'999}).nodes.empty());
}

TEST(NodeList, APageWithLongNamesEndsEarly) {
  testing::GlbBuilder builder = cubeOnCube();
  builder.json["nodes"][0]["name"] = std::string(5 << 20, 'n');
  const NodeList list = nodesOf(load(builder), {});
  EXPECT_EQ(list.nodes.size(), 1u);
  EXPECT_EQ(list.next, 0);
}

const Repair kRounded{"A number is beyond its limit by rounding", "it is brought to the limit"};
const Repair kTwice{"An index is listed twice", "it counts once"};

TEST(Findings, OneWarningForEachKindOfRepairCountsThePlacesAndNamesTheFirst) {
  Findings findings;
  findings.warn("A texture is left out.");
  findings.repair(kRounded, "/materials/0");
  findings.repair(kTwice, "/scenes/0");
  findings.repair(kRounded, "/materials/7");
  EXPECT_FALSE(findings.refused());
  EXPECT_THAT(
      findings.takeWarnings(),
      ElementsAre("A number is beyond its limit by rounding; it is brought to the limit (2 places, the first is "
                  "/materials/0).",
                  "An index is listed twice; it counts once (/scenes/0).", "A texture is left out."));
}

TEST(Findings, WhatOthersRepairedCountsAsIfFoundHere) {
  Findings findings;
  findings.repair(kRounded, "/materials/0");
  Findings other;
  other.repair(kRounded, "/materials/1");
  other.repair(kRounded, "/materials/2");
  findings.take(std::move(other));
  EXPECT_THAT(findings.takeWarnings(),
              ElementsAre("A number is beyond its limit by rounding; it is brought to the limit "
                          "(3 places, the first is /materials/0)."));
}

TEST(Findings, AFileThatHasToConformIsRefusedWhereItWouldBeRepaired) {
  Findings findings(Conformance::strict);
  findings.repair(kRounded, "/materials/0");
  EXPECT_TRUE(findings.violated());
  EXPECT_FALSE(findings.refused()) << "the rest of the file is looked at, too";
  const Problems problems = findings.takeProblems();
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].code, ProblemCode::invalidScene);
  EXPECT_EQ(problems[0].pointer, "/materials/0");
  EXPECT_EQ(problems[0].detail,
            "A number is beyond its limit by rounding. Without `strict`, it is brought to the limit.");
}

TEST(Findings, APartThatIsLeftOutTakesItsProblemsAlong) {
  Findings part;
  part.invalid("/cameras/0/yfov", "The field of view is too wide.", "< 180", "200");
  part.repair(kRounded, "/cameras/0/znear");
  Findings findings;
  EXPECT_EQ(findings.leaveOut(std::move(part), "the camera is left out"),
            "The field of view is too wide. (/cameras/0/yfov)");
  EXPECT_EQ(findings.leaveOut(Findings(), "nothing is left out"), "");
  EXPECT_FALSE(findings.refused());
  EXPECT_THAT(findings.takeWarnings(),
              ElementsAre("A number is beyond its limit by rounding; it is brought to the limit (/cameras/0/znear).",
                          "The field of view is too wide; the camera is left out (/cameras/0/yfov: 200)."));
}

TEST(Findings, LimitsRefuseThePartAndTheFile) {
  Findings part;
  part.tooLarge("/animations/0", "There are too many keyframes.", "8", "9");
  Findings findings;
  findings.leaveOut(std::move(part), "the channel is left out");
  EXPECT_TRUE(findings.refused());
}

} // namespace
} // namespace gnomon
