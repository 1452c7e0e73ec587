#include "tests/renderer/scene/load.h"
#include "tests/support/compressed_models.h"

namespace gnomon {
namespace {

using nlohmann::json;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr const char* kName = "EXT_meshopt_compression";
const std::string kPositions = "/bufferViews/0/extensions/EXT_meshopt_compression";
const std::string kTriangles = "/bufferViews/3/extensions/EXT_meshopt_compression";

testing::GlbBuilder model() {
  return testing::meshoptModel(testing::torus(20));
}

json& extension(testing::GlbBuilder& builder, std::size_t view) {
  return builder.json["bufferViews"][view]["extensions"][kName];
}

TEST(Meshopt, DecodesWhatWasEncoded) {
  const testing::Shape shape = testing::torus(20);
  for (const char* name : {"EXT_meshopt_compression", "KHR_meshopt_compression"}) {
    const Scene scene = load(testing::meshoptModel(shape, name));
    ASSERT_EQ(scene.summary.triangles, 800u);
    const Aabb bounds = scene.scenes[0].bounds;
    EXPECT_NEAR(bounds.max.x, 2.75, 1e-4);
    EXPECT_NEAR(bounds.min.y, -0.75, 1e-4);
    for (std::size_t i = 0; i < scene.positions.size(); ++i) {
      const glm::dvec3 p(scene.positions[i]);
      const glm::dvec3 ring = 2.0 * glm::normalize(glm::dvec3(p.x, 0, p.z));
      EXPECT_NEAR(glm::length(p - ring), 0.75, 1e-4);
      EXPECT_GT(glm::dot(glm::normalize(p - ring), glm::dvec3(scene.attributes[i].normal)), 0.999);
    }
  }
}

TEST(Meshopt, ReadsNoFallbackBytes) {
  testing::GlbBuilder builder = model();
  builder.json["buffers"][1]["uri"] = "not_uploaded.bin";
  EXPECT_EQ(load(builder).summary.triangles, 800u);
  builder.json["buffers"][1] = {{"byteLength", builder.json["buffers"][1]["byteLength"]}};
  EXPECT_EQ(load(builder).summary.triangles, 800u) << "without bytes it needs no mark";
  builder.json["buffers"][1]["uri"] = "not_uploaded.bin";
  EXPECT_THAT(findingsOf(builder), HasSubstr("/buffers/1/uri"));
}

TEST(Meshopt, RefusesPlainViewsOfAFallbackBuffer) {
  expectTold(model(), {{"/bufferViews/2/extensions", nullptr, "/bufferViews/2/buffer"},
                       {kPositions + "/buffer", 1, kPositions + "/buffer"}});
}

TEST(Meshopt, HoldsClaimsAgainstTheCompressedBytes) {
  testing::GlbBuilder builder = model();
  const std::uint64_t many = std::uint64_t{1} << 40;
  extension(builder, 3)["count"] = 3 * many;
  builder.json["bufferViews"][3]["byteLength"] = 12 * many;
  builder.json["buffers"][1]["byteLength"] = 13 * many;
  const Problems problems = problemsOf(builder);
  ASSERT_THAT(problems, Contains(ProblemAt(ProblemCode::invalidScene, kTriangles + "/count")));
  EXPECT_THAT(problems[0].actual, HasSubstr(std::to_string(3 * many)));
  builder = model();
  extension(builder, 0)["count"] = many;
  builder.json["bufferViews"][0]["byteLength"] = 12 * many;
  builder.json["buffers"][1]["byteLength"] = 13 * many;
  EXPECT_THAT(problemsOf(builder), Contains(ProblemAt(ProblemCode::invalidScene, kPositions + "/count")));
}

TEST(Meshopt, HoldsTheDecodedBytesAgainstTheLimit) {
  const std::size_t points = testing::torus(20).positions.size();
  expectLimit(model(), &Limits::maxDecodedBytes, points * (12 + 4 + 8) + 4 * 2400, kTriangles + "/count");
}

TEST(Meshopt, RefusesMembersThatContradictEachOther) {
  for (const auto& [member, value, place] : {Change{kTriangles + "/count", 2401, kTriangles + "/count"},
                                             {kTriangles + "/count", 2403, kTriangles + "/count"},
                                             {kTriangles + "/byteStride", 8, kTriangles + "/byteStride"},
                                             {kTriangles + "/filter", "OCTAHEDRAL", kTriangles + "/filter"},
                                             {kPositions + "/byteStride", 0, kPositions + "/byteStride"},
                                             {kPositions + "/filter", "QUATERNION", kPositions + "/byteStride"},
                                             {kPositions + "/mode", "INDICES", kPositions + "/filter"},
                                             {kPositions + "/mode", "POINTS", kPositions + "/mode"},
                                             {kPositions + "/filter", "COLOR", kPositions + "/filter"},
                                             {kPositions + "/buffer", 2, kPositions + "/buffer"}}) {
    testing::GlbBuilder builder = model();
    builder.json[json::json_pointer(member)] = value;
    EXPECT_THAT(problemsOf(builder), Contains(ProblemAt(ProblemCode::invalidScene, place))) << member << value;
  }
}

TEST(Meshopt, TellsDamagedAndNewerDataApart) {
  testing::GlbBuilder builder = model();
  builder.binary[0] = 0xA1; // the header of version 1
  Problems problems = problemsOf(builder);
  ASSERT_THAT(problems, Contains(ProblemAt(ProblemCode::invalidScene, kPositions)));
  EXPECT_THAT(problems[0].detail, HasSubstr("version 1"));
  builder.binary[0] = 0;
  EXPECT_THAT(problemsOf(builder), Contains(ProblemAt(ProblemCode::invalidScene, kPositions)));
}

TEST(Meshopt, TakesFlippedBytes) {
  const testing::GlbBuilder sound = model();
  takeFlippedBytes(sound, sound.binary.size(), 3);
}

} // namespace
} // namespace gnomon
