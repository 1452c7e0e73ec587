#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

#include "tests/renderer/scene/load.h"
#include "tests/support/compressed_models.h"

namespace gnomon {
namespace {

using nlohmann::json;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::string kPrimitive = "/meshes/0/primitives/0";
const std::string kPlace = kPrimitive + "/extensions/KHR_draco_mesh_compression";

testing::GlbBuilder model(bool edgebreaker = true) {
  return testing::dracoModel(testing::torus(20), edgebreaker);
}

TEST(Draco, DecodesWhatWasEncoded) {
  for (const bool edgebreaker : {false, true}) {
    const Scene scene = load(model(edgebreaker));
    ASSERT_EQ(scene.summary.triangles, 800u);
    EXPECT_NEAR(scene.scenes[0].bounds.max.x, 2.75, 1e-3);
    EXPECT_NEAR(scene.scenes[0].bounds.min.y, -0.75, 1e-3);
    for (std::size_t i = 0; i < scene.positions.size(); ++i) {
      const glm::dvec3 p(scene.positions[i]);
      const glm::dvec3 ring = 2.0 * glm::normalize(glm::dvec3(p.x, 0, p.z));
      EXPECT_NEAR(glm::length(p - ring), 0.75, 1e-3);
      EXPECT_GT(glm::dot(glm::normalize(p - ring), glm::dvec3(scene.attributes[i].normal)), 0.999);
      const glm::dvec2 angle = glm::dvec2(scene.attributes[i].uv0) * 2.0 * std::numbers::pi;
      EXPECT_NEAR(2 * std::cos(angle.x), ring.x, 0.005);
      EXPECT_NEAR(2 * std::sin(angle.x), ring.z, 0.005);
      EXPECT_NEAR(0.75 * std::sin(angle.y), p.y, 0.005);
    }
  }
}

TEST(Draco, DrawsTheTrianglesThatTheStreamHas) {
  for (const bool edgebreaker : {false, true}) {
    for (const int corners : {3, 2397, 2403}) {
      testing::GlbBuilder builder = model(edgebreaker);
      builder.json["accessors"][3]["count"] = corners;
      const Scene scene = load(builder);
      EXPECT_EQ(scene.summary.triangles, 800u);
      EXPECT_THAT(scene.summary.warnings, Contains(HasSubstr("800")));
    }
  }
}

TEST(Draco, TakesOtherNumbersOfVerticesThatTrianglesCanUse) {
  for (const bool edgebreaker : {false, true}) {
    testing::GlbBuilder builder = model(edgebreaker);
    const auto points = builder.json["accessors"][0]["count"].get<std::size_t>();
    for (std::size_t i = 0; i < 3; ++i) builder.json["accessors"][i]["count"] = points - 5;
    const Scene scene = load(builder);
    EXPECT_EQ(scene.positions.size(), points);
    EXPECT_THAT(scene.summary.warnings, Contains(HasSubstr(std::to_string(points))));
  }
  testing::Shape shape = testing::torus(4);
  shape.positions.resize(97); // three for each of the 32 triangles, and one
  shape.normals.resize(97, glm::vec3(0, 1, 0));
  shape.texCoords.resize(97);
  const Problems problems = problemsOf(testing::dracoModel(shape, false));
  ASSERT_THAT(problems, ElementsAre(ProblemAt(ProblemCode::invalidScene, kPlace)));
  EXPECT_EQ(problems[0].limit, "96");
  EXPECT_EQ(problems[0].actual, "97");
}

TEST(Draco, HoldsAttributesAgainstTheAccessorsTypes) {
  expectTold(model(), {{"/accessors/2/type", "VEC4", kPlace + "/attributes/TEXCOORD_0: 2 x FLOAT"},
                       {"/accessors/1/componentType", 5120, kPlace + "/attributes/NORMAL"},
                       {"/accessors/1/count", 5, kPrimitive + "/attributes/NORMAL"}});
}

TEST(Draco, HoldsEveryClaimAgainstTheLimits) {
  for (const bool edgebreaker : {false, true}) {
    const testing::GlbBuilder builder = model(edgebreaker);
    const auto points = builder.json["accessors"][0]["count"].get<std::size_t>();
    expectLimit(builder, &Limits::maxDecodedBytes, 800 * 12 + points * (12 + 12 + 8), kPlace);
    expectLimit(builder, &Limits::maxTriangles, 800, kPlace);
    expectBeyond(builder, &Limits::maxVertices, points - 1, kPlace);
  }
}

TEST(Draco, RefusesAttributesThatOneSideDoesNotHave) {
  const std::string attributes = kPlace + "/attributes";
  expectTold(model(), {{attributes + "/COLOR_0", 2, attributes + "/COLOR_0"},
                       {attributes + "/NORMAL", 77, kPlace},
                       {attributes + "/POSITION", nullptr, attributes},
                       {attributes + "/NORMAL", -1, attributes + "/NORMAL"}});
}

TEST(Draco, RefusesWhatItCanNotRead) {
  const auto problemsWith = [](std::size_t at, std::uint8_t value) {
    testing::GlbBuilder builder = model();
    builder.binary[at] = value;
    return problemsOf(builder);
  };
  EXPECT_THAT(problemsWith(0, 'X'), Contains(ProblemAt(ProblemCode::invalidScene, kPlace)));
  EXPECT_THAT(problemsWith(5, 1), Contains(ProblemAt(ProblemCode::invalidScene, kPlace)));
  EXPECT_THAT(problemsWith(7, 0), Contains(ProblemAt(ProblemCode::invalidScene, kPlace))) << "a point cloud";
  EXPECT_THAT(problemsWith(8, 9), Contains(ProblemAt(ProblemCode::invalidScene, kPlace))) << "no such method";
  const Problems problems = problemsWith(10, 0x80);
  ASSERT_THAT(problems, Contains(ProblemAt(ProblemCode::invalidScene, kPlace)));
  EXPECT_THAT(problems[0].detail, HasSubstr("metadata"));
  testing::GlbBuilder builder = model();
  builder.json["meshes"][0]["primitives"][0]["mode"] = 5;
  EXPECT_THAT(problemsOf(builder), Contains(ProblemAt(ProblemCode::invalidScene, kPrimitive + "/mode")));
}

void takeCutAndFlippedBytes(const testing::GlbBuilder& sound) {
  const auto length = sound.json["bufferViews"][0]["byteLength"].get<std::size_t>();
  for (std::size_t bytes = 1; bytes < length; bytes += 1 + length / 200) {
    testing::GlbBuilder builder = sound;
    builder.json["bufferViews"][0]["byteLength"] = bytes;
    EXPECT_FALSE(problemsOf(builder).empty()) << bytes;
  }
  takeFlippedBytes(sound, length, 1);
}

TEST(Draco, TakesCutAndFlippedBytesOfSequences) {
  takeCutAndFlippedBytes(model(false));
}

TEST(Draco, TakesCutAndFlippedBytesOfEdgebreaker) {
  takeCutAndFlippedBytes(model(true));
}

/// Of each count that the stream states in four bytes, wherever that is: a decoder that follows it takes seconds.
TEST(Draco, OrientationsAreNoMoreThanCorners) {
  const testing::GlbBuilder sound = model();
  const auto length = sound.json["bufferViews"][0]["byteLength"].get<std::size_t>();
  for (std::size_t at = 11; at + 4 <= length; ++at) {
    testing::GlbBuilder builder = sound;
    std::fill_n(builder.binary.begin() + static_cast<std::ptrdiff_t>(at), 3, 0xFF);
    builder.binary[at + 3] = 0x7F;
    const auto begin = std::chrono::steady_clock::now();
    for (const Problem& problem : problemsOf(builder)) EXPECT_NE(problem.code, ProblemCode::internal);
    ASSERT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(2)) << "at byte " << at;
  }
}

} // namespace
} // namespace gnomon
