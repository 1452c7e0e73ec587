// Primitives from the file to the scene's arrays: topologies, attributes, normals, what is left out.
#include <cmath>
#include <limits>

#include "tests/renderer/scene/load.h"

namespace gnomon {
namespace {

using nlohmann::json;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/// The corner positions of triangle `t` of primitive `p`.
std::array<glm::vec3, 3> cornersOf(const Scene& scene, std::size_t p, std::size_t t) {
  const Primitive& primitive = scene.primitives[p];
  std::array<glm::vec3, 3> corners{};
  for (std::size_t i = 0; i < 3; ++i) {
    corners[i] = scene.positions[primitive.baseVertex + scene.indices[primitive.firstIndex + 3 * t + i]];
  }
  return corners;
}

/// Four points of a square and a primitive over them with the given mode and indices.
testing::GlbBuilder square(int mode, const std::vector<std::uint16_t>& indices = {}) {
  testing::GlbBuilder builder;
  json primitive = {{"attributes", {{"POSITION", builder.addPoints({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}})}}},
                    {"mode", mode}};
  if (!indices.empty()) primitive["indices"] = builder.addShortIndices(indices);
  builder.addMeshNode(builder.addMesh(primitive));
  return builder;
}

TEST(Mesh, LoadsACube) {
  const Scene scene = load(testing::cube());
  ASSERT_EQ(scene.primitives.size(), 1u);
  const Primitive& primitive = scene.primitives.front();
  EXPECT_EQ(primitive.indexCount, 36u);
  EXPECT_EQ(primitive.vertexCount, 24u);
  EXPECT_EQ(primitive.clusterCount, 1u);
  EXPECT_EQ(primitive.bounds.min, glm::dvec3(-1));
  EXPECT_EQ(primitive.bounds.max, glm::dvec3(1));
  for (std::size_t t = 0; t < 12; ++t) { // every triangle faces outwards, as its normals do
    const auto [a, b, c] = cornersOf(scene, 0, t);
    const glm::vec3 normal = glm::normalize(glm::cross(b - a, c - a));
    EXPECT_GT(glm::dot(normal, a), 0.9f);
    EXPECT_EQ(scene.attributes[scene.indices[3 * t]].normal, normal);
  }
}

TEST(Mesh, UnrollsStripsWithTheirWinding) {
  const Scene scene = load(square(5));
  ASSERT_EQ(scene.indices.size(), 6u);
  for (std::size_t t = 0; t < 2; ++t) {
    const auto [a, b, c] = cornersOf(scene, 0, t);
    EXPECT_GT(glm::cross(b - a, c - a).z, 0) << t;
  }
}

TEST(Mesh, UnrollsFansWithTheirWinding) {
  const Scene scene = load(square(6, {0, 1, 3, 2}));
  ASSERT_EQ(scene.indices.size(), 6u);
  for (std::size_t t = 0; t < 2; ++t) {
    const auto [a, b, c] = cornersOf(scene, 0, t);
    EXPECT_GT(glm::cross(b - a, c - a).z, 0) << t;
  }
}

TEST(Mesh, LeavesOutPointsAndLinesWithAWarning) {
  for (const int mode : {0, 1, 2, 3}) {
    const Scene scene = load(square(mode));
    EXPECT_THAT(scene.primitives, IsEmpty());
    EXPECT_THAT(scene.summary.warnings, ElementsAre(HasSubstr("points or lines")));
  }
}

TEST(Mesh, WarnsOfIncompleteTriangles) {
  const Scene scene = load(square(4));
  EXPECT_EQ(scene.summary.triangles, 1u);
  EXPECT_THAT(scene.summary.warnings, ElementsAre(HasSubstr("incomplete")));
  EXPECT_THAT(load(square(5, {0, 1})).primitives, IsEmpty());
}

TEST(Mesh, RefusesIndicesOfNoVertex) {
  for (const std::uint16_t index : {std::uint16_t{4}, std::uint16_t{65535}}) {
    EXPECT_THAT(problemsOf(square(4, {0, 1, index})),
                ElementsAre(ProblemAt(ProblemCode::invalidScene, "/meshes/0/primitives/0/indices")));
  }
}

TEST(Mesh, RefusesThePrimitiveRestartValue) {
  testing::GlbBuilder builder;
  const std::vector<testing::Point> points(300, testing::Point{0, 0, 0});
  const int position = builder.addPoints(points);
  const int indices = builder.addAccessor(std::vector<std::uint8_t>{0, 255, 1}, "SCALAR", 5121, 3);
  builder.addMesh({{"attributes", {{"POSITION", position}}}, {"indices", indices}});
  EXPECT_THAT(problemsOf(builder), ElementsAre(ProblemAt(ProblemCode::invalidScene, "/meshes/0/primitives/0/indices")));
}

TEST(Mesh, RefusesAccessorsThatDoNotFit) {
  expectTold(testing::plane(), {{"/accessors/1/count", 3, "/meshes/0/primitives/0/attributes/NORMAL"},
                                {"/accessors/0/type", "VEC2", "/meshes/0/primitives/0/attributes/POSITION"},
                                {"/accessors/3/componentType", 5122, "/meshes/0/primitives/0/indices"},
                                {"/accessors/3/normalized", true, "/meshes/0/primitives/0/indices"}});
}

TEST(Mesh, MakesFlatNormalsWhereThereAreNone) {
  const Scene scene = load(square(4, {0, 1, 2, 1, 3, 2}));
  EXPECT_EQ(scene.positions.size(), 6u) << "each triangle has its own corners";
  for (const VertexAttributes& vertex : scene.attributes) EXPECT_EQ(vertex.normal, glm::vec3(0, 0, 1));
}

TEST(Mesh, ReplacesNormalsWithoutADirection) {
  testing::GlbBuilder builder = testing::plane();
  const std::vector<float> normals{0, 0, 0, kNan, 0, 1, 0, 5, 0, 0, 1, 0};
  builder.json["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = builder.addAccessor(normals, "VEC3", 5126, 4);
  const Scene scene = load(builder);
  for (const VertexAttributes& vertex : scene.attributes) EXPECT_EQ(vertex.normal, glm::vec3(0, 1, 0));
  EXPECT_THAT(scene.summary.warnings, ElementsAre(HasSubstr("not finite"), HasSubstr("length 0")));
}

TEST(Mesh, ReadsTangentsOnlyBesideNormals) {
  testing::GlbBuilder builder = testing::plane();
  json& attributes = builder.json["meshes"][0]["primitives"][0]["attributes"];
  const std::vector<float> tangents{2, 0, 0, -1, 2, 0, 0, -1, 2, 0, 0, -1, 2, 0, 0, -1};
  attributes["TANGENT"] = builder.addAccessor(tangents, "VEC4", 5126, 4);
  Scene scene = load(builder);
  EXPECT_TRUE(scene.primitives.front().hasTangents);
  for (const VertexAttributes& vertex : scene.attributes) EXPECT_EQ(vertex.tangent, glm::vec4(1, 0, 0, -1));
  attributes.erase("NORMAL");
  EXPECT_FALSE(load(builder).primitives.front().hasTangents);
}

TEST(Mesh, ReplacesTangentsWithoutADirection) {
  testing::GlbBuilder builder = testing::plane();
  builder.json["meshes"][0]["primitives"][0]["attributes"]["TANGENT"] =
      builder.addAccessor(std::vector<float>(16, 0.0f), "VEC4", 5126, 4);
  for (const VertexAttributes& vertex : load(builder).attributes) {
    EXPECT_NEAR(glm::length(glm::vec3(vertex.tangent)), 1, 1e-6);
    EXPECT_NEAR(glm::dot(glm::vec3(vertex.tangent), vertex.normal), 0, 1e-6);
  }
}

TEST(Mesh, ReadsBothTextureCoordinates) {
  testing::GlbBuilder builder = testing::plane();
  builder.json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_1"] = builder.addAccessor(
      std::vector<std::uint8_t>{0, 255, 0, 0, 51, 0, 0, 0, 0, 0, 0, 0, 255, 255, 0, 0}, "VEC2", 5121, 4, true);
  builder.json["bufferViews"].back()["byteStride"] = 4;
  const Scene scene = load(builder);
  EXPECT_EQ(scene.attributes[1].uv0, glm::vec2(1, 1));
  EXPECT_EQ(scene.attributes[0].uv1, glm::vec2(0, 1));
  EXPECT_FLOAT_EQ(scene.attributes[1].uv1.x, 0.2f);
}

TEST(Mesh, ReadsVertexColors) {
  const auto colorOf = [](auto values, const char* type, int componentType, bool normalized) {
    testing::GlbBuilder builder = testing::triangle();
    const int view = builder.addView(values.data(), sizeof values, static_cast<int>(sizeof values / 3));
    json accessor = {{"bufferView", view}, {"componentType", componentType}, {"count", 3}, {"type", type}};
    accessor["normalized"] = normalized;
    builder.json["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = builder.add("accessors", accessor);
    const Scene scene = load(builder);
    EXPECT_TRUE(scene.materials[static_cast<std::size_t>(scene.primitives.at(0).material)].hasVertexColors);
    return (*scene.attributes).at(0).color;
  };
  EXPECT_EQ(colorOf(std::array<float, 12>{0.5f, 0, 2, 0.25f}, "VEC4", 5126, false),
            glm::u16vec4(32768, 0, 65535, 16384));
  EXPECT_EQ(colorOf(std::array<float, 9>{1, kNan, -1}, "VEC3", 5126, false), glm::u16vec4(65535, 0, 0, 65535));
  EXPECT_EQ(colorOf(std::array<std::uint8_t, 12>{255, 0, 51, 255}, "VEC4", 5121, true),
            glm::u16vec4(65535, 0, 13107, 65535));
  EXPECT_EQ(colorOf(std::array<std::uint16_t, 12>{65535, 1, 2, 0}, "VEC3", 5123, true),
            glm::u16vec4(65535, 1, 2, 65535));
  EXPECT_FALSE(load(testing::triangle()).materials.front().hasVertexColors);
}

TEST(Mesh, DropsTrianglesThatAreNotFinite) {
  testing::GlbBuilder builder;
  const int position = builder.addPoints({{0, 0, 0},
                                          {1, 0, 0},
                                          {0, 1, 0},
                                          {0, 0, 0},
                                          {kNan, 0, 0},
                                          {0, 1, 0},
                                          {0, 0, 0},
                                          {1, 0, 0},
                                          {0, std::numeric_limits<float>::infinity(), 0}});
  builder.addMeshNode(builder.addMesh({{"attributes", {{"POSITION", position}}}}));
  const Scene scene = load(builder);
  EXPECT_EQ(scene.summary.triangles, 1u);
  EXPECT_EQ(scene.scenes[0].bounds.max, glm::dvec3(1, 1, 0));
  EXPECT_THAT(scene.summary.warnings,
              Contains(HasSubstr("not finite; they are left out (/meshes/0/primitives/0: 2 triangles)")));
}

TEST(Mesh, DropsTrianglesWithoutArea) {
  const Scene scene = load(square(4, {0, 0, 1, 0, 1, 2, 1, 1, 1}));
  EXPECT_EQ(scene.summary.triangles, 1u);
  EXPECT_THAT(scene.summary.warnings, IsEmpty());
}

TEST(Mesh, KeepsOnlyTheVerticesThatAreUsed) {
  testing::GlbBuilder builder;
  std::vector<testing::Point> points;
  for (int i = 0; i < 1000; ++i) points.push_back({static_cast<float>(i), static_cast<float>(i % 7), 0});
  const int position = builder.addPoints(points);
  const int normal = builder.addPoints(std::vector<testing::Point>(1000, testing::Point{0, 0, 1}));
  for (const std::uint16_t first : {std::uint16_t{10}, std::uint16_t{900}}) {
    const int indices =
        builder.addShortIndices({first, static_cast<std::uint16_t>(first + 1), static_cast<std::uint16_t>(first + 9)});
    builder.addMeshNode(
        builder.addMesh({{"attributes", {{"POSITION", position}, {"NORMAL", normal}}}, {"indices", indices}}));
  }
  const Scene scene = load(builder);
  EXPECT_EQ(scene.positions.size(), 6u);
  EXPECT_EQ(cornersOf(scene, 1, 0)[0].x, 900);
}

TEST(Mesh, LeavesOutPrimitivesWithoutPositions) {
  testing::GlbBuilder builder = testing::plane();
  builder.json["meshes"][0]["primitives"][0]["attributes"].erase("POSITION");
  const Scene scene = load(builder);
  EXPECT_THAT(scene.primitives, IsEmpty());
  EXPECT_THAT(scene.summary.warnings, ElementsAre(HasSubstr("without positions")));
}

TEST(Mesh, HoldsTrianglesAndVerticesAgainstTheLimits) {
  expectLimit(testing::cube(), &Limits::maxTriangles, 12, "/meshes/0/primitives/0");
  expectLimit(testing::cube(), &Limits::maxVertices, 24, "/meshes/0/primitives/0");
}

} // namespace
} // namespace gnomon
