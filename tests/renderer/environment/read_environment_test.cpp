#include "renderer/environment/read_environment.h"

#include <array>
#include <gtest/gtest.h>
#include <limits>
#include <string>
#include <vector>

#include "renderer/environment/environment_file.h"
#include "renderer/image/picture_encode.h"
#include "tests/renderer/made_environment.h"

namespace gnomon {
namespace {

constexpr const char* kHead = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n";

Bytes bytesOf(const std::string& text) {
  return Bytes(text.begin(), text.end());
}

/// 8 x 4 texels of one color that stand for themselves.
std::string flatTexels(const std::string& texel = std::string("\x80\x40\x20\x81", 4)) {
  std::string texels;
  for (int i = 0; i < 32; ++i) texels += texel;
  return texels;
}

Problem problemOf(const std::string& file) {
  const auto map = readEnvironment(bytesOf(file));
  return map ? Problem{ProblemCode::internal, "", "it was read"} : map.problems().front();
}

void expectUniform(const std::string& file, const glm::vec3& radiance) {
  const auto map = readEnvironment(bytesOf(file));
  ASSERT_TRUE(map) << map.problems().front().detail;
  EXPECT_EQ(glm::ivec2(map->width, map->height), glm::ivec2(8, 4));
  ASSERT_EQ(map->texels.size(), 32u);
  for (const glm::vec3& texel : map->texels) EXPECT_EQ(texel, radiance);
}

TEST(Rgbe, FlatTexelsOfBothMagics) {
  expectUniform(std::string(kHead) + "\n-Y 4 +X 8\n" + flatTexels(), {1, 0.5f, 0.25f});
  expectUniform("#?RGBE\n# a comment\nGAMMA=1\n\n-Y 4 +X 8\n" + flatTexels(), {1, 0.5f, 0.25f});
  expectUniform(std::string(kHead) + "\n-Y 4 +X 8\n" + flatTexels() + "and more", {1, 0.5f, 0.25f});
}

TEST(Rgbe, ExposuresAreTakenBack) {
  expectUniform(std::string(kHead) + "EXPOSURE=2\nEXPOSURE= 0.5\nEXPOSURE=4\n\n-Y 4 +X 8\n" + flatTexels(),
                {0.25f, 0.125f, 0.0625f});
  expectUniform(std::string(kHead) + "COLORCORR=2 1 0.5\n\n-Y 4 +X 8\n" + flatTexels(), {0.5f, 0.5f, 0.5f});
  EXPECT_EQ(problemOf(std::string(kHead) + "EXPOSURE=-1\n\n-Y 4 +X 8\n" + flatTexels()).code, ProblemCode::malformed);
}

TEST(Rgbe, BothWaysOfRuns) {
  const std::string first("\x80\x40\x20\x81", 4);
  const std::string again("\x01\x01\x01\x07", 4); // seven more of it
  std::string old;
  for (int y = 0; y < 4; ++y) old += first + again;
  expectUniform(std::string(kHead) + "\n-Y 4 +X 8\n" + old, {1, 0.5f, 0.25f});
  std::string planes;
  for (int y = 0; y < 4; ++y) {
    planes += std::string("\x02\x02\x00\x08", 4) + "\x88\x80";                   // a run of 8
    planes += std::string("\x08") + std::string(8, '\x40');                      // 8 that stand for themselves
    planes += std::string("\x84\x20\x04") + std::string(4, '\x20') + "\x88\x81"; // both, and a run
  }
  expectUniform(std::string(kHead) + "\n-Y 4 +X 8\n" + planes, {1, 0.5f, 0.25f});
  EXPECT_EQ(problemOf(std::string(kHead) + "\n-Y 4 +X 8\n" + std::string("\x02\x02\x00\x08\x89\x80", 6)).detail,
            "The .hdr file is broken: a run does not end with its row.");
}

TEST(Rgbe, EveryCutIsAProblemAndNoneMore) {
  const std::string whole = std::string(kHead) + "\n-Y 4 +X 8\n" + flatTexels();
  for (std::size_t size = 0; size < whole.size(); ++size) {
    EXPECT_EQ(problemOf(whole.substr(0, size)).code, ProblemCode::malformed) << size;
  }
}

TEST(Rgbe, WhatIsNotReadIsNamed) {
  const Problem turned = problemOf(std::string(kHead) + "\n+Y 4 +X 8\n" + flatTexels());
  EXPECT_EQ(turned.code, ProblemCode::unsupportedFeature);
  EXPECT_EQ(turned.actual, "+Y 4 +X 8");
  EXPECT_EQ(problemOf(std::string(kHead) + "\n-X 8 +Y 4\n" + flatTexels()).code, ProblemCode::unsupportedFeature);
  const Problem xyz = problemOf("#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 4 +X 8\n" + flatTexels());
  EXPECT_EQ(xyz.code, ProblemCode::unsupportedFeature);
  EXPECT_EQ(xyz.actual, "32-bit_rle_xyze");
}

TEST(Environments, SidesAreWithinTheLimits) {
  const auto sized = [](const std::string& size) { return problemOf(std::string(kHead) + "\n" + size + "\n"); };
  EXPECT_EQ(sized("-Y 8192 +X 16384").code, ProblemCode::tooLarge);
  EXPECT_EQ(sized("-Y 8192 +X 16384").limit, "8192x4096");
  EXPECT_EQ(sized("-Y 4 +X 9").code, ProblemCode::invalidValue);
  EXPECT_EQ(sized("-Y 3 +X 6").actual, "6x3");
  EXPECT_EQ(sized("-Y 99999999999 +X 8").code, ProblemCode::malformed);
  EXPECT_EQ(sized("-Y 4096 +X 8192").code, ProblemCode::malformed) << "allowed, but cut short";
}

TEST(Environments, ATexelThatIsTooBrightIsNamed) {
  std::string texels = flatTexels();
  texels.replace(4 * 11, 4, std::string("\x80\x80\x80\xff", 4));
  const Problem problem = problemOf(std::string(kHead) + "\n-Y 4 +X 8\n" + texels);
  EXPECT_EQ(problem.code, ProblemCode::invalidValue);
  EXPECT_NE(problem.detail.find("R of column 3, row 1"), std::string::npos) << problem.detail;
  EXPECT_EQ(problem.limit, "0..1e+09");
}

Bytes exrOf(const std::vector<std::string>& channels, const std::vector<float>& texel, int at, float there) {
  std::vector<float> pixels;
  for (int i = 0; i < 32; ++i) pixels.insert(pixels.end(), texel.begin(), texel.end());
  pixels[static_cast<std::size_t>(at)] = there;
  const Image image{8, 4, channels, std::move(pixels)};
  const std::array layers{ImageLayer{"", &image}};
  return *encodeExr(layers, ExrCompression::zip, ExrPixelType::float_);
}

TEST(Environments, ExrOfColorsIsRead) {
  const auto map = readEnvironment(exrOf({"R", "G", "B", "Z"}, {2, 3, 4, -1}, 0, 7));
  ASSERT_TRUE(map) << map.problems().front().detail;
  EXPECT_EQ(map->at(0, 0), glm::vec3(7, 3, 4));
  EXPECT_EQ(map->at(7, 3), glm::vec3(2, 3, 4));
  const auto grey = readEnvironment(exrOf({"Y"}, {2}, 0, 5));
  ASSERT_TRUE(grey);
  EXPECT_EQ(grey->at(0, 0), glm::vec3(5));
  EXPECT_EQ(readEnvironment(exrOf({"Z"}, {2}, 0, 5)).problems().front().code, ProblemCode::unsupportedFeature);
}

TEST(Environments, NumbersThatLightCantHaveAreProblems) {
  for (const float bad :
       {-1.0f, 2e9f, std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()}) {
    const auto map = readEnvironment(exrOf({"R", "G", "B"}, {1, 1, 1}, 3 * 17 + 1, bad));
    ASSERT_FALSE(map) << bad;
    EXPECT_NE(map.problems().front().detail.find("G of column 1, row 2"), std::string::npos)
        << map.problems().front().detail;
  }
}

TEST(EnvironmentFiles, AreReadOnceForWhatSettlingNeeds) {
  const EnvironmentFile file(
      testing::hdrFile(16, [](const glm::dvec3& towards) { return glm::dvec3(towards.y > 0.97 ? 1e5 : 1.0); }));
  EXPECT_FALSE(file.facts(SunExtraction::none));
  ASSERT_TRUE(file.read(SunExtraction::none));
  const auto known = file.facts(SunExtraction::none);
  ASSERT_TRUE(known && *known);
  EXPECT_EQ((*known)->width, 32);
  EXPECT_FALSE((*known)->sun);
  EXPECT_FALSE(file.facts(SunExtraction::auto_)) << "the sun was not looked for";
  EXPECT_EQ(file.memory(), file.size() + 32u * 16u * sizeof(glm::vec3));
  const EnvironmentFile broken(bytesOf(kHead));
  EXPECT_FALSE(broken.read(SunExtraction::auto_));
  ASSERT_TRUE(broken.facts(SunExtraction::auto_)) << "it is known to be broken";
  EXPECT_FALSE(*broken.facts(SunExtraction::removed));
  EXPECT_EQ(broken.memory(), broken.size());
}

} // namespace
} // namespace gnomon
