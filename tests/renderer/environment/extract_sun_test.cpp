#include "renderer/environment/extract_sun.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <gtest/gtest.h>

#include "renderer/core/light.h"
#include "tests/renderer/environment/made_maps.h"

namespace gnomon {
namespace {

constexpr int kHeight = 256;
constexpr double kTexel = glm::pi<double>() / kHeight;

/// Light on surfaces that face it, from all directions.
glm::dvec3 energyOf(const EnvironmentMap& map) {
  glm::dvec3 sum(0);
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) sum += glm::dvec3(map.at(x, y)) * texelSolidAngle(map, y);
  }
  return sum;
}

/// Adds a disc, each texel by the share of its 64 points that lie within.
void addDisc(EnvironmentMap& map, const glm::dvec3& towards, double diameterDegrees, const glm::dvec3& radiance) {
  constexpr int kPoints = 8;
  const double least = std::cos(glm::radians(diameterDegrees / 2));
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      if (glm::dot(testing::texelDirection(map, x, y), towards) <
          std::cos(glm::radians(diameterDegrees) + 2 * kTexel)) {
        continue;
      }
      int inside = 0;
      for (int i = 0; i < kPoints * kPoints; ++i) {
        const glm::dvec2 place((x + (i % kPoints + 0.5) / kPoints) / map.width,
                               (y + (i / kPoints + 0.5) / kPoints) / map.height);
        inside += glm::dot(environmentDirection(place), towards) >= least ? 1 : 0;
      }
      map.texels[static_cast<std::size_t>(y * map.width + x)] +=
          glm::vec3(radiance * (double(inside) / (kPoints * kPoints)));
    }
  }
}

const glm::dvec3 kSun = glm::normalize(glm::dvec3(0.3, 0.6, -0.5));

double degreesBetween(const glm::dvec3& a, const glm::dvec3& b) {
  return glm::degrees(std::acos(std::min(glm::dot(a, b), 1.0)));
}

void expectEnergyKept(const glm::dvec3& before, const EnvironmentMap& rest, const FoundSun& sun) {
  const glm::dvec3 after = energyOf(rest) + sun.irradiance;
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(after[i], before[i], 1e-4 * before[i]) << i;
}

class Discs : public ::testing::TestWithParam<double> {};

TEST_P(Discs, AreFoundWithTheirPlaceSizeColorAndLight) {
  EnvironmentMap map = testing::uniformMap(kHeight, {0.4f, 0.5f, 0.7f});
  const glm::dvec3 radiance(3e4, 2.4e4, 1.5e4);
  addDisc(map, kSun, GetParam(), radiance);
  const glm::dvec3 before = energyOf(map);
  const auto sun = takeSun(map);
  ASSERT_TRUE(sun);
  EXPECT_LT(degreesBetween(sun->towards, kSun), 0.25 * glm::degrees(kTexel));
  const double angle = glm::two_pi<double>() * (1 - std::cos(glm::radians(GetParam() / 2)));
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(sun->irradiance[i], radiance[i] * angle, 0.04 * radiance[i] * angle);
  EXPECT_NEAR(glm::degrees(sun->angularDiameter), GetParam(), std::max(0.1 * GetParam(), glm::degrees(kTexel)));
  expectEnergyKept(before, map, *sun);
  for (const glm::vec3& texel : map.texels) EXPECT_LT(texel.x, 0.41f);
}

INSTANTIATE_TEST_SUITE_P(Diameters, Discs, ::testing::Values(0.53, 1.0, 2.0, 5.0));

TEST(TakeSun, TakesTheHaloDownToTheRingAroundIt) {
  EnvironmentMap map = testing::uniformMap(kHeight, glm::vec3(1));
  addDisc(map, kSun, 2.5, glm::dvec3(300));
  addDisc(map, kSun, 1, glm::dvec3(5e4));
  const glm::dvec3 before = energyOf(map);
  const auto sun = takeSun(map);
  ASSERT_TRUE(sun);
  EXPECT_LT(glm::degrees(sun->angularDiameter), 1.5);
  expectEnergyKept(before, map, *sun);
  EXPECT_LT(std::ranges::max(map.texels, {}, [](const glm::vec3& each) { return each.x; }).x, 1.01f);
}

TEST(TakeSun, CrossesTheSeamOfThePicture) {
  EnvironmentMap map = testing::uniformMap(kHeight, glm::vec3(0.5f));
  const glm::dvec3 seam = glm::normalize(glm::dvec3(-1, 0.4, 0));
  addDisc(map, seam, 2, glm::dvec3(2e4));
  const auto sun = takeSun(map);
  ASSERT_TRUE(sun);
  EXPECT_LT(degreesBetween(sun->towards, seam), 0.25 * glm::degrees(kTexel));
  EXPECT_NEAR(glm::degrees(sun->angularDiameter), 2, glm::degrees(kTexel));
}

TEST(TakeSun, TakesTheBrighterOfTwoLampsAndLeavesTheOther) {
  EnvironmentMap map = testing::uniformMap(kHeight, glm::vec3(0.1f));
  const glm::dvec3 other = glm::normalize(glm::dvec3(-0.5, 0.4, 0.6));
  addDisc(map, kSun, 2, glm::dvec3(3e4));
  addDisc(map, other, 2, glm::dvec3(2e4));
  const glm::dvec3 before = energyOf(map);
  const auto sun = takeSun(map);
  ASSERT_TRUE(sun);
  EXPECT_LT(degreesBetween(sun->towards, kSun), 0.25 * glm::degrees(kTexel));
  expectEnergyKept(before, map, *sun);
  const glm::dvec2 place = environmentPlace(other) * glm::dvec2(map.width, map.height);
  EXPECT_EQ(map.at(static_cast<int>(place.x), static_cast<int>(place.y)).x, 2e4f + 0.1f);
}

TEST(TakeSun, LeavesWhatIsNoSun) {
  const auto isLeft = [](EnvironmentMap map) {
    const std::vector<glm::vec3> before = map.texels;
    return !takeSun(map) && map.texels == before;
  };
  EXPECT_TRUE(isLeft(testing::uniformMap(kHeight, glm::vec3(0)))) << "black";
  EXPECT_TRUE(isLeft(testing::uniformMap(kHeight, glm::vec3(3)))) << "everywhere the same";
  EXPECT_TRUE(isLeft(testing::noisyMap(kHeight))) << "many bright texels";
  EnvironmentMap window = testing::uniformMap(kHeight, glm::vec3(0.1f));
  addDisc(window, kSun, 20, glm::dvec3(300));
  EXPECT_TRUE(isLeft(window)) << "a window of 20 degrees";
  EnvironmentMap large = testing::uniformMap(kHeight, glm::vec3(0.0001f));
  addDisc(large, kSun, 8, glm::dvec3(1e4));
  EXPECT_TRUE(isLeft(large)) << "too wide, though bright";
  EnvironmentMap spark = testing::uniformMap(kHeight, glm::vec3(1));
  addDisc(spark, kSun, 0.5, glm::dvec3(1500));
  EXPECT_TRUE(isLeft(spark)) << "bright, but hardly any light";
}

} // namespace
} // namespace gnomon
