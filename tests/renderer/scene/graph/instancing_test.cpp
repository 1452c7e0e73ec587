#include "tests/renderer/scene/geometry.h"
#include "tests/renderer/scene/load.h"

namespace gnomon {
namespace {

using nlohmann::json;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

const std::string kAttributes = "/nodes/0/extensions/EXT_mesh_gpu_instancing/attributes";

/// A cube whose node makes three copies of it.
testing::GlbBuilder instanced() {
  testing::GlbBuilder builder = testing::cube();
  const int translations = builder.addPoints({{0, 0, 0}, {10, 0, 0}, {0, 20, 0}});
  const int scales = builder.addPoints({{1, 1, 1}, {2, 1, 1}, {1, 1, -1}});
  // The second is turned by 90 degrees about Y: X to -Z. In 16 bits, normalized.
  const int rotations = builder.addAccessor(
      std::vector<std::int16_t>{0, 0, 0, 32767, 0, 23170, 0, 23170, 0, 0, 0, 32767}, "VEC4", 5122, 3, true);
  builder.json["extensionsRequired"] = builder.json["extensionsUsed"] = {"EXT_mesh_gpu_instancing"};
  builder.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
      {"TRANSLATION", translations}, {"ROTATION", rotations}, {"SCALE", scales}};
  builder.json["nodes"][0]["translation"] = {0, 0, 100};
  return builder;
}

json& attributes(testing::GlbBuilder& builder) {
  return builder.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
}

TEST(Instancing, PlacesEachCopyRelativeToItsNode) {
  const Scene scene = load(instanced());
  const std::vector<Instance>& copies = scene.scenes[0].instances;
  ASSERT_EQ(copies.size(), 3u);
  EXPECT_EQ(scene.summary.triangles, 36u);
  EXPECT_EQ(scene.primitives.size(), 1u) << "one mesh, placed three times";
  expectNear(glm::dvec3(copies[0].worldFromLocal[3]), {0, 0, 100});
  expectNear(glm::dvec3(copies[1].worldFromLocal[3]), {10, 0, 100});
  expectNear(glm::dvec3(copies[1].worldFromLocal[0]), {0, 0, -2}, 1e-4);
  EXPECT_NEAR(copies[1].bounds.max.z, 102, 1e-4);
  EXPECT_LT(glm::determinant(glm::dmat3(copies[2].worldFromLocal)), 0) << "mirrored by its scale";
  EXPECT_EQ(copies[2].node, 0);
  EXPECT_NEAR(scene.scenes[0].bounds.max.y, 21, 1e-6);
}

TEST(Instancing, LeavesOutCopiesScaledToNothing) {
  testing::GlbBuilder builder = instanced();
  attributes(builder)["SCALE"] = builder.addPoints({{1, 1, 1}, {0, 1, 0}, {1, 1, 1}});
  EXPECT_EQ(load(builder).scenes[0].instances.size(), 2u);
}

TEST(Instancing, HoldsAccessorsAgainstEachOther) {
  testing::GlbBuilder builder = instanced();
  const int two = builder.addPoints({{1, 1, 1}, {1, 1, 1}});
  const int zeros = builder.addAccessor(std::vector<float>(12), "VEC4", 5126, 3);
  expectTold(builder, {{kAttributes + "/SCALE", two, kAttributes + "/SCALE"},
                       {kAttributes + "/ROTATION", attributes(builder)["SCALE"], kAttributes + "/ROTATION"},
                       {kAttributes, json::object(), kAttributes},
                       {kAttributes + "/SCALE", 99, kAttributes + "/SCALE"},
                       {kAttributes + "/ROTATION", zeros, kAttributes}});
}

TEST(Instancing, CountsCopiesBeforeItMakesThem) {
  expectLimit(instanced(), &Limits::maxInstances, 4, "/scenes/0"); // the node and its three copies
  expectBeyond(instanced(), &Limits::maxTriangles, 35, "/scenes/0");
  testing::GlbBuilder builder = instanced();
  const int many =
      builder.add("accessors", {{"componentType", 5126}, {"count", std::uint64_t{1} << 52}, {"type", "VEC3"}});
  attributes(builder) = {{"TRANSLATION", many}};
  EXPECT_THAT(problemsOf(builder), ElementsAre(ProblemAt(ProblemCode::tooLarge, "/scenes/0")));
}

TEST(NodeVisibility, HidesWhatHangsBelowButNoCamera) {
  testing::GlbBuilder builder = testing::cube();
  builder.json["nodes"][0]["extensions"]["KHR_node_visibility"]["visible"] = false;
  builder.json["nodes"][0]["children"] = {1};
  builder.add("nodes", {{"mesh", 0}, {"camera", 0}, {"extensions", {{"KHR_node_visibility", {{"visible", true}}}}}});
  builder.add("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}});
  builder.addMeshNode(0);
  builder.json["extensionsRequired"] = builder.json["extensionsUsed"] = {"KHR_node_visibility"};
  const Scene scene = load(builder);
  ASSERT_EQ(scene.scenes[0].instances.size(), 1u);
  EXPECT_EQ(scene.scenes[0].instances[0].node, 2);
  EXPECT_EQ(scene.scenes[0].cameras.size(), 1u);
  EXPECT_THAT(scene.summary.warnings, IsEmpty());
  builder.json["nodes"][0]["extensions"]["KHR_node_visibility"] = json::object();
  EXPECT_EQ(load(builder).scenes[0].instances.size(), 3u) << "visible unless it says otherwise";
}

} // namespace
} // namespace gnomon
