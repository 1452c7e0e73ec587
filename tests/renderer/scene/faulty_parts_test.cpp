// One attribute, triangle, primitive or buffer that is faulty is left out, and the rest of the file is as without it.
#include <limits>
#include <rapidcheck/gtest.h>

#include "tests/renderer/scene/load.h"

namespace gnomon {
namespace {

using nlohmann::json;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
const std::string kPrimitive = "/meshes/0/primitives/0";

json& attributesOf(testing::GlbBuilder& builder) {
  return builder.json["meshes"][0]["primitives"][0]["attributes"];
}

void expectSameGeometry(const Scene& one, const Scene& other) {
  EXPECT_EQ(*one.positions, *other.positions);
  EXPECT_EQ(*one.indices, *other.indices);
  ASSERT_EQ(one.attributes.size(), other.attributes.size());
  for (std::size_t i = 0; i < one.attributes.size(); ++i) {
    const VertexAttributes& a = (*one.attributes)[i];
    const VertexAttributes& b = (*other.attributes)[i];
    EXPECT_EQ(a.normal, b.normal);
    EXPECT_EQ(a.uv0, b.uv0);
    EXPECT_EQ(a.uv1, b.uv1);
    EXPECT_EQ(a.color, b.color);
  }
}

/// The faulty file is drawn like the other, and says at which place it is not.
void expectRepaired(const testing::GlbBuilder& faulty, const testing::GlbBuilder& like, const std::string& pointer) {
  const Scene scene = load(faulty);
  expectSameGeometry(scene, load(like));
  EXPECT_THAT(scene.summary.warnings, Contains(HasSubstr(pointer))) << pointer;
  EXPECT_THAT(load(like).summary.warnings, Not(Contains(HasSubstr(pointer)))) << pointer;
}

testing::GlbBuilder planeWithout(const char* attribute) {
  testing::GlbBuilder builder = testing::plane();
  attributesOf(builder).erase(attribute);
  return builder;
}

TEST(FaultyParts, AnAttributeThatCannotBeReadIsLeftOut) {
  for (const auto& [name, accessor] : {std::pair{"NORMAL", 1}, {"TEXCOORD_0", 2}}) {
    const std::pair<const char*, json> faults[] = {{"count", 5},       {"count", 3},
                                                   {"count", 0},       {"count", 9007199254740991},
                                                   {"byteOffset", 4},  {"byteOffset", 9007199254740988},
                                                   {"type", "SCALAR"}, {"type", "MAT4"}};
    for (const auto& [key, value] : faults) {
      testing::GlbBuilder builder = testing::plane();
      builder.json["accessors"][static_cast<std::size_t>(accessor)][key] = value;
      SCOPED_TRACE(std::string(name) + " " + key);
      expectRepaired(builder, planeWithout(name), kPrimitive + "/attributes/" + name);
    }
  }
}

TEST(FaultyParts, AColorThatCannotBeReadIsLeftOut) {
  testing::GlbBuilder builder = testing::plane();
  attributesOf(builder)["COLOR_0"] = builder.addAccessor(std::vector<float>(8, 0.5f), "VEC2", 5126, 4);
  expectRepaired(builder, testing::plane(), kPrimitive + "/attributes/COLOR_0");
}

TEST(FaultyParts, ColorsOfIntegersCountAsNormalized) {
  testing::GlbBuilder plain = testing::plane();
  const std::vector<std::uint8_t> colors{255, 0, 51, 255, 0, 255, 0, 255, 0, 0, 255, 102, 9, 8, 7, 6};
  attributesOf(plain)["COLOR_0"] = plain.addAccessor(colors, "VEC4", 5121, 4, true);
  testing::GlbBuilder builder = plain;
  builder.json["accessors"].back().erase("normalized");
  expectRepaired(builder, plain, kPrimitive + "/attributes/COLOR_0");
}

TEST(FaultyParts, WhatIsBeyondTheComponentsOfAnAttributeIsNotUsed) {
  testing::GlbBuilder builder = testing::plane();
  attributesOf(builder)["TEXCOORD_0"] =
      builder.addAccessor(std::vector<float>{0, 1, 7, 1, 1, kNan, 1, 0, 7, 0, 0, 7}, "VEC3", 5126, 4);
  expectRepaired(builder, testing::plane(), kPrimitive + "/attributes/TEXCOORD_0");
  builder = testing::plane();
  attributesOf(builder)["NORMAL"] =
      builder.addAccessor(std::vector<float>{0, 1, 0, 9, 0, 1, 0, 9, 0, 1, 0, 9, 0, 1, 0, 9}, "VEC4", 5126, 4);
  expectRepaired(builder, testing::plane(), kPrimitive + "/attributes/NORMAL");
}

TEST(FaultyParts, MoreElementsThanPositionsAreNotUsed) {
  testing::GlbBuilder builder = testing::plane();
  attributesOf(builder)["TEXCOORD_0"] =
      builder.addAccessor(std::vector<float>{0, 1, 1, 1, 1, 0, 0, 0, 5, 5}, "VEC2", 5126, 5);
  expectRepaired(builder, testing::plane(), kPrimitive + "/attributes/TEXCOORD_0");
}

TEST(FaultyParts, StridesThatAreNoneMeanTightlyPacked) {
  for (const int stride : {0, 1, 4, 8}) {
    testing::GlbBuilder builder = testing::plane();
    builder.json["bufferViews"][0]["byteStride"] = stride;
    expectRepaired(builder, testing::plane(), stride == 0 ? "/bufferViews/0/byteStride" : "/accessors/0");
  }
}

TEST(FaultyParts, WhatIsNotAlignedIsReadWhereItIs) {
  testing::GlbBuilder builder = testing::plane();
  const Bytes positions(builder.binary.begin(), builder.binary.begin() + 48);
  const int view = builder.addView(Bytes(52));
  std::copy(positions.begin(), positions.end(),
            builder.binary.begin() + builder.json["bufferViews"][view]["byteOffset"].get<int>() + 2);
  builder.json["accessors"][0]["bufferView"] = view;
  builder.json["accessors"][0]["byteOffset"] = 2;
  expectRepaired(builder, testing::plane(), "/accessors/0");
}

TEST(FaultyParts, TrianglesOfVerticesThatDoNotExistAreLeftOut) {
  for (const std::uint16_t index : {std::uint16_t{4}, std::uint16_t{65534}, std::uint16_t{65535}}) {
    testing::GlbBuilder builder = testing::plane();
    builder.json["meshes"][0]["primitives"][0]["indices"] =
        builder.addShortIndices({0, 1, 2, 0, 1, index, 0, 2, 3, index, index, index});
    expectRepaired(builder, testing::plane(), kPrimitive + "/indices");
  }
}

TEST(FaultyParts, TheRestartValueOfBytesNamesNoVertex) {
  testing::GlbBuilder builder;
  std::vector<testing::Point> points(256, testing::Point{0, 5, 0});
  points[1] = {1, 0, 0};
  points[2] = {0, 0, 1};
  const int position = builder.addPoints(points);
  const int indices = builder.addAccessor(std::vector<std::uint8_t>{0, 1, 2, 1, 2, 255}, "SCALAR", 5121, 6);
  builder.addMeshNode(builder.addMesh({{"attributes", {{"POSITION", position}}}, {"indices", indices}}));
  testing::GlbBuilder like = builder;
  like.json["accessors"][static_cast<std::size_t>(indices)]["count"] = 3;
  expectRepaired(builder, like, kPrimitive + "/indices");
}

TEST(FaultyParts, StripsAndFansBeginAgainAfterARestartValue) {
  const std::vector<testing::Point> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 2, 0}, {1, 2, 0}};
  const auto drawn = [&](int mode, const std::vector<std::uint16_t>& indices) {
    testing::GlbBuilder builder;
    builder.addMeshNode(builder.addMesh({{"attributes", {{"POSITION", builder.addPoints(points)}}},
                                         {"mode", mode},
                                         {"indices", builder.addShortIndices(indices)}}));
    return builder;
  };
  expectRepaired(drawn(5, {0, 1, 2, 65535, 1, 3, 2, 4}), drawn(4, {0, 1, 2, 1, 3, 2, 3, 4, 2}),
                 kPrimitive + "/indices");
  expectRepaired(drawn(6, {0, 1, 2, 65535, 1, 3, 2, 4}), drawn(4, {1, 2, 0, 3, 2, 1, 2, 4, 1}),
                 kPrimitive + "/indices");
  expectRepaired(drawn(5, {0, 1, 2, 9, 3, 5, 4}), drawn(4, {0, 1, 2, 3, 5, 4}), kPrimitive + "/indices");
}

/// A sound plane, and a second mesh that is a plane as well.
testing::GlbBuilder twoPlanes() {
  testing::GlbBuilder builder = testing::plane();
  json second = builder.json["meshes"][0];
  for (const char* name : {"POSITION", "NORMAL", "TEXCOORD_0"}) {
    json& accessor = second["primitives"][0]["attributes"][name];
    accessor = builder.add("accessors", builder.json["accessors"][accessor.get<std::size_t>()]);
  }
  json& indices = second["primitives"][0]["indices"];
  indices = builder.add("accessors", builder.json["accessors"][indices.get<std::size_t>()]);
  builder.addMeshNode(builder.add("meshes", second));
  return builder;
}

TEST(FaultyParts, APrimitiveWithoutReadablePositionsOrIndicesIsLeftOut) {
  const std::tuple<int, const char*, json, const char*> faults[] = {{4, "count", 0, "attributes/POSITION"},
                                                                    {4, "count", 500, "attributes/POSITION"},
                                                                    {4, "type", "VEC2", "attributes/POSITION"},
                                                                    {4, "byteOffset", 1 << 20, "attributes/POSITION"},
                                                                    {7, "count", 7000, "indices"},
                                                                    {7, "componentType", 5126, "indices"},
                                                                    {7, "componentType", 5122, "indices"},
                                                                    {7, "type", "VEC2", "indices"},
                                                                    {7, "count", 0, "indices"}};
  for (const auto& [accessor, key, value, place] : faults) {
    testing::GlbBuilder builder = twoPlanes();
    builder.json["accessors"][static_cast<std::size_t>(accessor)][key] = value;
    SCOPED_TRACE(std::string(place) + " " + key + " " + value.dump());
    expectRepaired(builder, testing::plane(), std::string("/meshes/1/primitives/0/") + place);
  }
}

TEST(FaultyParts, AFileOfWhichNothingIsLeftIsRefused) {
  testing::GlbBuilder builder = testing::plane();
  builder.json["accessors"][0]["count"] = 500;
  EXPECT_THAT(problemsOf(builder), Contains(ProblemAt(ProblemCode::invalidScene, "/accessors/0")));
  builder = testing::plane();
  builder.json["meshes"][0]["primitives"][0]["indices"] = builder.addShortIndices({7, 8, 9});
  EXPECT_THAT(problemsOf(builder), ElementsAre(ProblemAt(ProblemCode::invalidScene, kPrimitive + "/indices")));
}

TEST(FaultyParts, ABufferThatIsMissingTakesOnlyWhatLiesInIt) {
  testing::GlbBuilder builder = testing::plane();
  SceneBundle bundle = bundleOf("");
  json file = builder.json;
  file["buffers"] = {{{"byteLength", builder.binary.size()}, {"uri", "here.bin"}},
                     {{"byteLength", 48}, {"uri", "gone.bin"}}};
  file["bufferViews"].push_back({{"buffer", 1}, {"byteLength", 48}});
  file["accessors"].push_back({{"bufferView", 4}, {"componentType", 5126}, {"count", 4}, {"type", "VEC3"}});
  file["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = 4;
  const std::string text = file.dump();
  bundle.model = Bytes(text.begin(), text.end());
  bundle.files["here.bin"] = builder.binary;
  const Scene scene = load(bundle);
  expectSameGeometry(scene, load(planeWithout("NORMAL")));
  EXPECT_THAT(scene.summary.warnings, Contains(HasSubstr("/buffers/1/uri: \"gone.bin\"")));

  bundle.files.clear();
  EXPECT_THAT(problemsOf(bundle), Contains(ProblemAt(ProblemCode::invalidScene, "/buffers/0/uri")));
}

TEST(FaultyParts, OfABufferThatIsCutShortTheBeginningIsRead) {
  testing::GlbBuilder builder = twoPlanes();
  builder.json["buffers"] = {{{"byteLength", builder.binary.size()}, {"uri", "plane.bin"}}};
  const int normals =
      builder.add("bufferViews", {{"buffer", 0}, {"byteOffset", builder.binary.size() - 4}, {"byteLength", 48}});
  builder.json["accessors"][5]["bufferView"] = normals;
  SceneBundle bundle = bundleOf(builder.json.dump());
  bundle.files["plane.bin"] = builder.binary;
  const Scene scene = load(bundle);
  EXPECT_EQ(scene.summary.triangles, 4u);
  EXPECT_THAT(scene.summary.warnings, Contains(HasSubstr("/meshes/1/primitives/0/attributes/NORMAL")));
}

/// A sound plane and any one fault in a second: the first stays as it was.
RC_GTEST_PROP(FaultyParts, AnyFaultOfOnePartLeavesTheRestAsItWas, ()) {
  testing::GlbBuilder builder = twoPlanes();
  json& accessor = builder.json["accessors"][*rc::gen::inRange<std::size_t>(4, 8)];
  const std::vector<std::pair<const char*, json>> faults{
      {"count", 0},
      {"count", 1},
      {"count", 3},
      {"count", 5},
      {"count", 4'000'000'000},
      {"byteOffset", 1},
      {"byteOffset", 3},
      {"byteOffset", 100000},
      {"type", "SCALAR"},
      {"type", "VEC2"},
      {"type", "VEC4"},
      {"type", "MAT3"},
      {"componentType", 5120},
      {"componentType", 5121},
      {"componentType", 5123},
      {"componentType", 5125},
      {"componentType", 5126},
      {"normalized", true},
      {"sparse",
       json::parse(R"({"count":9,"indices":{"bufferView":0,"componentType":5121},"values":{"bufferView":0}})")},
      {"sparse",
       json::parse(R"({"count":2,"indices":{"bufferView":3,"componentType":5121},"values":{"bufferView":0}})")}};
  const auto& fault = faults[*rc::gen::inRange<std::size_t>(0, faults.size())];
  accessor[fault.first] = fault.second;
  const auto result = loadGltf(builder.bundle());
  RC_ASSERT(result);
  const Scene& scene = **result;
  const Scene plain = load(testing::plane());
  RC_ASSERT(!scene.primitives.empty());
  RC_ASSERT(scene.positions.size() >= plain.positions.size());
  RC_ASSERT(std::equal(plain.positions.begin(), plain.positions.end(), scene.positions.begin()));
  RC_ASSERT(std::equal(plain.indices.begin(), plain.indices.end(), scene.indices.begin()));
  RC_ASSERT(scene.primitives[0].bounds.min == plain.primitives[0].bounds.min);
}

} // namespace
} // namespace gnomon
