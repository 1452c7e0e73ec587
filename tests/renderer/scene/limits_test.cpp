// Every limit on a scene, walked with the smallest file beyond it: refused, before memory is taken, with the number.
#include "tests/renderer/scene/load.h"
#include "tests/support/compressed_models.h"

namespace gnomon {
namespace {

using nlohmann::json;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

/// The file is refused for `actual` where only `limit` would do.
void expectRefused(const testing::GlbBuilder& builder, const std::string& pointer, std::uint64_t limit,
                   const std::string& actual, const Limits& limits = kLimits) {
  const Problems problems = problemsOf(builder, limits);
  ASSERT_THAT(problems, ElementsAre(ProblemAt(ProblemCode::tooLarge, pointer)));
  EXPECT_THAT(problems[0].limit, StartsWith(std::to_string(limit)));
  EXPECT_THAT(problems[0].actual, HasSubstr(actual));
}

std::string oneMoreThan(std::uint64_t limit) {
  return std::to_string(limit + 1);
}

/// An accessor of zeros, which takes no byte of the file.
int addZeros(testing::GlbBuilder& builder, const char* type, int componentType, std::uint64_t count) {
  return builder.add("accessors", {{"componentType", componentType}, {"count", count}, {"type", type}});
}

json& primitiveOf(testing::GlbBuilder& builder) {
  return builder.json["meshes"][0]["primitives"][0];
}

/// A square whose material uses images of these sizes.
testing::GlbBuilder textured(const std::vector<std::pair<int, int>>& sizes) {
  testing::GlbBuilder builder = testing::plane();
  const char* const places[] = {"normalTexture", "occlusionTexture", "emissiveTexture"};
  builder.add("materials", json::object());
  primitiveOf(builder)["material"] = 0;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    const Bytes header =
        pngHeader(static_cast<std::uint32_t>(sizes[i].first), static_cast<std::uint32_t>(sizes[i].second));
    builder.add("images", {{"mimeType", "image/png"}, {"bufferView", builder.addView(header)}});
    builder.add("textures", {{"source", i}});
    builder.json["materials"][0][places[i]] = {{"index", i}};
  }
  return builder;
}

TEST(SceneLimits, Nodes) {
  testing::GlbBuilder builder = testing::triangle();
  while (builder.json["nodes"].size() <= kLimits.maxNodes) builder.json["nodes"].push_back(json::object());
  expectRefused(builder, "/nodes", kLimits.maxNodes, oneMoreThan(kLimits.maxNodes));
}

TEST(SceneLimits, Materials) {
  testing::GlbBuilder builder = testing::triangle();
  for (std::size_t i = 0; i <= kLimits.maxMaterials; ++i) builder.add("materials", json::object());
  expectRefused(builder, "/materials", kLimits.maxMaterials, oneMoreThan(kLimits.maxMaterials));
}

TEST(SceneLimits, Images) {
  testing::GlbBuilder builder = testing::triangle();
  for (std::size_t i = 0; i <= kLimits.maxImages; ++i) builder.add("images", {{"uri", "data:,x"}});
  expectRefused(builder, "/images", kLimits.maxImages, oneMoreThan(kLimits.maxImages));
}

TEST(SceneLimits, TrianglesOfMeshes) {
  testing::GlbBuilder builder = testing::triangle();
  primitiveOf(builder)["mode"] = 5; // a strip
  primitiveOf(builder)["attributes"]["POSITION"] = addZeros(builder, "VEC3", 5126, kLimits.maxTriangles + 3);
  expectRefused(builder, "/meshes/0/primitives/0", kLimits.maxTriangles, oneMoreThan(kLimits.maxTriangles));
}

TEST(SceneLimits, TrianglesOfScenes) {
  testing::GlbBuilder builder = testing::cube(); // its 12 triangles again and again
  Limits limits;
  limits.maxTriangles = 12 * 1000;
  while (builder.json["nodes"].size() < 1001) builder.addMeshNode(0);
  expectRefused(builder, "/scenes/0", limits.maxTriangles, std::to_string(12 * 1001), limits);
}

TEST(SceneLimits, Vertices) {
  testing::GlbBuilder builder = testing::triangle();
  const std::size_t vertices = 3 * (kLimits.maxVertices / 3 + 1); // those of whole triangles count
  primitiveOf(builder)["attributes"]["POSITION"] = addZeros(builder, "VEC3", 5126, vertices);
  expectRefused(builder, "/meshes/0/primitives/0", kLimits.maxVertices, std::to_string(vertices));
}

TEST(SceneLimits, SparseValues) {
  testing::GlbBuilder builder = testing::triangle();
  const int view = builder.addView(Bytes(16, 0));
  const json values = {{"bufferView", view}};
  const json indices = {{"bufferView", view}, {"componentType", 5125}};
  const int accessor = addZeros(builder, "SCALAR", 5126, kLimits.maxVertices + 1);
  builder.json["accessors"][static_cast<std::size_t>(accessor)]["sparse"] = {
      {"count", kLimits.maxVertices + 1}, {"indices", indices}, {"values", values}};
  expectRefused(builder, "/accessors", kLimits.maxVertices, oneMoreThan(kLimits.maxVertices));
}

TEST(SceneLimits, MorphTargets) {
  testing::GlbBuilder builder = testing::triangle();
  for (std::size_t i = 0; i <= kLimits.maxMorphTargets; ++i)
    primitiveOf(builder)["targets"].push_back({{"POSITION", 0}});
  expectRefused(builder, "/meshes/0/primitives/0/targets", kLimits.maxMorphTargets,
                oneMoreThan(kLimits.maxMorphTargets));
}

TEST(SceneLimits, MorphedVertices) {
  testing::GlbBuilder builder = testing::triangle();
  const std::size_t vertices = 3 * (kLimits.maxMorphedVertices / 30 + 1);
  const int positions = addZeros(builder, "VEC3", 5126, vertices);
  primitiveOf(builder)["attributes"] = {{"POSITION", positions}};
  for (int i = 0; i < 10; ++i) primitiveOf(builder)["targets"].push_back({{"POSITION", positions}});
  expectRefused(builder, "/meshes/0/primitives/0/targets", kLimits.maxMorphedVertices, std::to_string(10 * vertices));
}

TEST(SceneLimits, Joints) {
  testing::GlbBuilder builder = testing::triangle();
  json joints = json::array();
  while (joints.size() <= kLimits.maxJoints) {
    joints.push_back(builder.json["nodes"].size());
    builder.json["nodes"].push_back(json::object());
  }
  builder.add("skins", {{"joints", joints}});
  expectRefused(builder, "/skins/0/joints", kLimits.maxJoints, oneMoreThan(kLimits.maxJoints));
}

TEST(SceneLimits, Instances) {
  testing::GlbBuilder builder = testing::triangle();
  const int places = addZeros(builder, "VEC3", 5126, kLimits.maxInstances);
  builder.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"] = {{"attributes", {{"TRANSLATION", places}}}};
  builder.json["extensionsUsed"] = {"EXT_mesh_gpu_instancing"};
  expectRefused(builder, "/scenes/0", kLimits.maxInstances,
                std::to_string(kLimits.maxInstances) + " copies of 1 after 1");
}

TEST(SceneLimits, DecodedBytes) {
  const testing::Shape shape = testing::torus(20);
  const std::uint64_t indices = 4 * shape.indices.size();
  Limits limits;
  limits.maxDecodedBytes = indices - 1;
  expectRefused(testing::dracoModel(shape), "/meshes/0/primitives/0/extensions/KHR_draco_mesh_compression",
                limits.maxDecodedBytes, std::to_string(indices) + " bytes", limits);
  const std::uint64_t positions = 12 * shape.positions.size();
  limits.maxDecodedBytes = positions - 1;
  const Problems problems = problemsOf(testing::meshoptModel(shape), limits);
  ASSERT_FALSE(problems.empty());
  EXPECT_EQ(problems[0].code, ProblemCode::tooLarge);
  EXPECT_EQ(problems[0].pointer, "/bufferViews/0/extensions/EXT_meshopt_compression/count");
  EXPECT_EQ(problems[0].limit, std::to_string(positions - 1) + " bytes");
}

TEST(SceneLimits, ImageSide) {
  const int side = kLimits.maxImageSide;
  expectRefused(textured({{side + 1, 1}}), "/images/0", static_cast<std::uint64_t>(side), std::to_string(side + 1));
  expectRefused(textured({{1, side + 1}}), "/images/0", static_cast<std::uint64_t>(side), std::to_string(side + 1));
}

TEST(SceneLimits, ImagePixels) {
  const int side = kLimits.maxImageSide;
  const auto pixels = static_cast<std::uint64_t>(kLimits.maxImagePixels);
  ASSERT_EQ(std::uint64_t{2} * side * side, pixels);
  expectRefused(textured({{side, side}, {side, side}, {1, 1}}), "/images/2", pixels, oneMoreThan(pixels));
}

TEST(SceneLimits, NestingOfTheJson) {
  const std::string brackets(static_cast<std::size_t>(kLimits.maxJsonDepth), '[');
  const Problems problems = problemsOf(bundleOf("{\"extras\":" + brackets));
  ASSERT_THAT(problems, ElementsAre(ProblemAt(ProblemCode::tooLarge, "")));
  EXPECT_EQ(problems[0].limit, std::to_string(kLimits.maxJsonDepth));
}

TEST(SceneLimits, ValuesOfTheJson) {
  std::string text = "{\"extras\":[0";
  for (std::size_t i = 0; i < kLimits.maxJsonValues; ++i) text += ",0";
  const Problems problems = problemsOf(bundleOf(text + "]}"));
  ASSERT_THAT(problems, ElementsAre(ProblemAt(ProblemCode::tooLarge, "")));
  EXPECT_EQ(problems[0].limit, std::to_string(kLimits.maxJsonValues));
}

} // namespace
} // namespace gnomon
