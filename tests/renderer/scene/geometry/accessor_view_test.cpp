#include "renderer/scene/geometry/accessor_view.h"

#include "tests/renderer/scene/load.h"

namespace gnomon {
namespace {

using nlohmann::json;
using ::testing::Contains;
using ::testing::ElementsAre;

std::vector<glm::vec3> sortedPositions(const Scene& scene) {
  std::vector<glm::vec3> positions = scene.positions;
  std::sort(positions.begin(), positions.end(),
            [](const glm::vec3& a, const glm::vec3& b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); });
  return positions;
}

TEST(AccessorView, ReadsEveryComponentType) {
  const auto check = [](auto values, int type, bool normalized, double expected) {
    AccessorView view;
    view.data = reinterpret_cast<const std::uint8_t*>(values.data());
    view.count = 1;
    view.components = 2;
    view.stride = sizeof values;
    view.componentType = static_cast<ComponentType>(type);
    view.normalized = normalized;
    EXPECT_DOUBLE_EQ(view.read(0).y, expected) << type << (normalized ? " normalized" : "");
    EXPECT_EQ(view.read(0, glm::dvec4(9)).z, 9);
  };
  check(std::array<std::int8_t, 2>{0, -128}, 5120, false, -128);
  check(std::array<std::int8_t, 2>{0, -128}, 5120, true, -1);
  check(std::array<std::int8_t, 2>{0, 127}, 5120, true, 1);
  check(std::array<std::uint8_t, 2>{0, 51}, 5121, true, 0.2);
  check(std::array<std::int16_t, 2>{0, -32767}, 5122, true, -1);
  check(std::array<std::int16_t, 2>{0, -5}, 5122, false, -5);
  check(std::array<std::uint16_t, 2>{0, 65535}, 5123, true, 1);
  check(std::array<std::uint16_t, 2>{0, 65535}, 5123, false, 65535);
  check(std::array<std::uint32_t, 2>{0, 4000000000u}, 5125, false, 4e9);
  check(std::array<float, 2>{0, 1.5f}, 5126, false, 1.5);
}

TEST(AccessorView, ReadsQuantizedPositions) {
  testing::GlbBuilder builder;
  // i16 normalized, 8 bytes apart as KHR_mesh_quantization asks.
  const std::vector<std::int16_t> positions{0, 0, 0, 0, 32767, 0, 0, 0, 0, -32767, 0, 0};
  const int view = builder.addView(positions, 8);
  builder.add("accessors",
              {{"bufferView", view}, {"componentType", 5122}, {"normalized", true}, {"count", 3}, {"type", "VEC3"}});
  builder.addMeshNode(builder.addMesh({{"attributes", {{"POSITION", 0}}}}));
  EXPECT_THAT(sortedPositions(load(builder)), ElementsAre(glm::vec3(0, -1, 0), glm::vec3(0), glm::vec3(1, 0, 0)));
}

TEST(AccessorView, ReadsSparseAccessors) {
  testing::GlbBuilder builder = testing::triangle();
  const int indices = builder.addView(std::vector<std::uint16_t>{2});
  const int values = builder.addView(std::vector<float>{0, 7, 0});
  builder.json["accessors"][0]["sparse"] = {{"count", 1},
                                            {"indices", {{"bufferView", indices}, {"componentType", 5123}}},
                                            {"values", {{"bufferView", values}}}};
  EXPECT_THAT(sortedPositions(load(builder)), ElementsAre(glm::vec3(0), glm::vec3(0, 7, 0), glm::vec3(1, 0, 0)));
}

TEST(AccessorView, SparseWithoutABufferViewStartsFromZero) {
  testing::GlbBuilder builder = testing::triangle();
  const int indices = builder.addView(std::vector<std::uint8_t>{1, 2});
  const int values = builder.addView(std::vector<float>{3, 0, 0, 0, 4, 0});
  builder.json["accessors"][0].erase("bufferView");
  builder.json["accessors"][0]["sparse"] = {{"count", 2},
                                            {"indices", {{"bufferView", indices}, {"componentType", 5121}}},
                                            {"values", {{"bufferView", values}}}};
  EXPECT_THAT(sortedPositions(load(builder)), ElementsAre(glm::vec3(0), glm::vec3(0, 4, 0), glm::vec3(3, 0, 0)));
}

TEST(AccessorView, RefusesSparseLies) {
  testing::GlbBuilder sound = testing::triangle();
  const int indices = sound.addView(std::vector<std::uint16_t>{0, 2});
  const int values = sound.addView(std::vector<float>{0, 0, 0, 0, 7, 0});
  sound.json["accessors"][0]["sparse"] = {{"count", 2},
                                          {"indices", {{"bufferView", indices}, {"componentType", 5123}}},
                                          {"values", {{"bufferView", values}}}};
  ASSERT_TRUE(loadGltf(sound.bundle()));
  const std::size_t indexBytes = sound.json["bufferViews"][indices]["byteOffset"];

  const auto expectProblem = [](const testing::GlbBuilder& builder, const std::string& pointer) {
    EXPECT_THAT(problemsOf(builder), Contains(ProblemAt(ProblemCode::invalidScene, pointer)));
  };
  for (const auto& [first, second] : {std::pair<int, int>{2, 0}, {2, 2}, {0, 3}, {0, 65535}}) {
    testing::GlbBuilder builder = sound;
    builder.binary[indexBytes] = static_cast<std::uint8_t>(first);
    builder.binary[indexBytes + 2] = static_cast<std::uint8_t>(second & 0xFF);
    builder.binary[indexBytes + 3] = static_cast<std::uint8_t>(second >> 8);
    expectProblem(builder, "/accessors/0/sparse/indices");
  }
  testing::GlbBuilder builder = sound;
  builder.json["accessors"][0]["sparse"]["count"] = 4;
  expectProblem(builder, "/accessors/0/sparse/count");
  builder = sound;
  builder.json["accessors"][0]["sparse"]["count"] = 3;
  expectProblem(builder, "/accessors/0/sparse/indices");
  builder = sound;
  builder.json["accessors"][0]["sparse"]["values"]["byteOffset"] = 4;
  expectProblem(builder, "/accessors/0/sparse/values");
  builder = sound;
  builder.json["accessors"][0]["sparse"]["indices"]["byteOffset"] = 2147483647;
  expectProblem(builder, "/accessors/0/sparse/indices");
}

TEST(AccessorView, RefusesRangesBeyondTheBuffer) {
  const std::pair<const char*, json> lies[] = {
      {"/accessors/0/count", 4},
      {"/accessors/0/count", 4'000'000'000},
      {"/accessors/0/count", 9007199254740991},
      {"/accessors/0/byteOffset", 4},
      {"/accessors/0/byteOffset", 9007199254740988},
      {"/accessors/0/type", "VEC4"},
      {"/accessors/0/type", "MAT4"},
      {"/bufferViews/0/byteStride", 16},
      {"/bufferViews/0/byteStride", 252},
      {"/bufferViews/0/byteStride", 4}, // smaller than an element
      {"/bufferViews/0/byteLength", 35},
  };
  for (const auto& [pointer, lie] : lies) {
    testing::GlbBuilder builder = testing::triangle();
    builder.json[json::json_pointer(pointer)] = lie;
    EXPECT_THAT(findingsOf(builder), ::testing::HasSubstr("/accessors/0")) << pointer << " = " << lie;
  }
  for (const auto& [pointer, lie] : {std::pair<const char*, json>{"/bufferViews/0/byteLength", 37},
                                     {"/bufferViews/0/byteOffset", 1},
                                     {"/bufferViews/0/byteOffset", 9007199254740991}}) {
    testing::GlbBuilder builder = testing::triangle();
    builder.json[json::json_pointer(pointer)] = lie;
    EXPECT_THAT(findingsOf(builder), ::testing::HasSubstr("/bufferViews/0")) << pointer;
  }
}

TEST(AccessorView, RefusesMisalignedAccessors) {
  testing::GlbBuilder builder = testing::triangle();
  builder.binary.resize(40);
  builder.json["bufferViews"][0]["byteLength"] = 40;
  builder.json["accessors"][0]["byteOffset"] = 2;
  EXPECT_THAT(findingsOf(builder), ::testing::HasSubstr("/accessors/0"));
  builder.json["accessors"][0]["byteOffset"] = 4;
  EXPECT_TRUE(loadGltf(builder.bundle()));
}

TEST(AccessorView, CountsWithoutBytesMeetTheLimits) {
  testing::GlbBuilder builder = testing::triangle();
  builder.json["accessors"][0].erase("bufferView");
  builder.json["accessors"][0]["count"] = 4'000'000'000;
  EXPECT_THAT(problemsOf(builder), ElementsAre(ProblemAt(ProblemCode::tooLarge, "/meshes/0/primitives/0")));
}

TEST(AccessorView, IndicesWithoutABufferViewAreZerosUnderTheirSparseValues) {
  testing::GlbBuilder builder = testing::plane(); // six indices
  const int places = builder.addView(std::vector<std::uint8_t>{4, 5});
  const int values = builder.addView(std::vector<std::uint16_t>{1, 2});
  json& primitive = builder.json["meshes"][0]["primitives"][0];
  json indices = {{"componentType", 5123}, {"count", 6}, {"type", "SCALAR"}};
  primitive["indices"] = builder.add("accessors", indices);
  EXPECT_THAT(load(builder).primitives, ::testing::IsEmpty()) << "triangles of one corner";

  indices["sparse"] = {{"count", 2},
                       {"indices", {{"bufferView", places}, {"componentType", 5121}}},
                       {"values", {{"bufferView", values}}}};
  primitive["indices"] = builder.add("accessors", indices);
  const Scene sparse = load(builder);
  primitive["indices"] = builder.addShortIndices({0, 1, 2});
  const Scene plain = load(builder);
  EXPECT_EQ(sparse.indices.size(), 3u);
  EXPECT_EQ(sparse.indices, plain.indices);
  EXPECT_EQ(sparse.positions, plain.positions);
}

TEST(AccessorView, CountsOfIndicesWithoutBytesMeetTheLimits) {
  testing::GlbBuilder builder = testing::plane();
  const std::int64_t counts[] = {4'000'000'000, 9'007'199'254'740'991};
  for (const std::int64_t count : counts) {
    for (const int mode : {4, 5, 6}) {
      json& primitive = builder.json["meshes"][0]["primitives"][0];
      primitive["mode"] = mode;
      primitive["indices"] = builder.add("accessors", {{"componentType", 5125}, {"count", count}, {"type", "SCALAR"}});
      EXPECT_THAT(problemsOf(builder), ElementsAre(ProblemAt(ProblemCode::tooLarge, "/meshes/0/primitives/0")));
    }
  }
}

TEST(AccessorView, ManySparseAccessorsOnTheSameBytesMeetTheLimits) {
  testing::GlbBuilder builder = testing::triangle();
  const int indices = builder.addView(std::vector<std::uint8_t>{0, 1, 2});
  const json sparse = {
      {"count", 3}, {"indices", {{"bufferView", indices}, {"componentType", 5121}}}, {"values", {{"bufferView", 0}}}};
  for (int i = 0; i < 40; ++i) {
    builder.add("accessors", {{"componentType", 5126}, {"count", 3}, {"type", "VEC3"}, {"sparse", sparse}});
  }
  Limits limits;
  limits.maxVertices = 100;
  EXPECT_THAT(problemsOf(builder, limits), ElementsAre(ProblemAt(ProblemCode::tooLarge, "/accessors")));
}

} // namespace
} // namespace gnomon
