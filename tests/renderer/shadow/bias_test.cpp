#include <cmath>
#include <gtest/gtest.h>

#include "renderer/shadow/filter_kernel.h"
#include "tests/renderer/shadow/random_plan.h"

namespace gnomon {
namespace {

Filter pcf(int size) {
  return {FilterType::pcf, size};
}

TEST(Bias, X13_KernelsAndTheirBorders) {
  EXPECT_EQ(kernelOf({FilterType::hard, 7}).reach, 1);
  EXPECT_EQ(kernelOf({FilterType::hard, 7}).border, 2);
  EXPECT_EQ(kernelOf(pcf(3)).reach, 2);
  EXPECT_EQ(kernelOf(pcf(3)).border, 3);
  EXPECT_EQ(kernelOf(pcf(5)).reach, 3);
  EXPECT_EQ(kernelOf(pcf(5)).border, 4);
  EXPECT_EQ(kernelOf(pcf(7)).reach, 4);
  EXPECT_EQ(kernelOf(pcf(7)).border, 5);
  EXPECT_EQ(kernelOf({FilterType::pcss, 7}, 0.1).reach, 1);
  EXPECT_EQ(kernelOf({FilterType::pcss, 7}, 0.1).border, 2);
}

TEST(Bias, N6_PcssOfALightWithoutASizeIsOneComparison) {
  EXPECT_EQ(kernelOf({FilterType::pcss}, 0.1).kind, MapReadingKind::pcss);
  EXPECT_EQ(kernelOf({FilterType::pcss}, 0.1).lightRadius, 0.1);
  EXPECT_EQ(kernelOf({FilterType::pcss}).kind, MapReadingKind::texels);
  EXPECT_EQ(kernelOf({FilterType::pcss}).size, 1);
  EXPECT_EQ(kernelOf({FilterType::pcf}, 0.1).lightRadius, 0) << "knows no size";
}

/// By how much the map's plane stands nearer the light than the moved receiver, at worst over the texels that a lookup
/// weighs; positive = acne. Light space with z towards the light; the plane holds the origin.
double worstAcne(const glm::dvec3& normal, const glm::dvec2& texelSize, const glm::dvec2& phase, double reach) {
  const double sine = std::sqrt(std::max(0.0, 1.0 - normal.z * normal.z));
  const glm::dvec3 moved = normal * (normalOffset(reach, texelSize) * sine);
  double worst = -1e300;
  for (int x = -6; x <= 6; ++x) {
    for (int y = -6; y <= 6; ++y) {
      const glm::dvec2 steps = glm::dvec2(x, y) + phase; // texels from the lookup to this centre
      if (std::abs(steps.x) > reach || std::abs(steps.y) > reach) continue;
      const glm::dvec2 center = glm::dvec2(moved) + steps * texelSize;
      const double height = -(normal.x * center.x + normal.y * center.y) / normal.z;
      worst = std::max(worst, height - moved.z);
    }
  }
  return worst;
}

TEST(Bias, H4_M18_APlaneAtAnyTiltNeverShadowsItself) {
  EXPECT_TRUE(rc::check([](unsigned seed) {
    Dice dice(seed);
    const double tilt = glm::radians(dice.between(0, 85));
    const double around = dice.between(0, 6.2832);
    const glm::dvec3 normal(std::sin(tilt) * std::cos(around), std::sin(tilt) * std::sin(around), std::cos(tilt));
    const glm::dvec2 texelSize(dice.between(0.01, 1), dice.between(0.01, 1));
    const glm::dvec2 phase(dice.between(0, 1), dice.between(0, 1));
    for (const FilterKernel& kernel : {kernelOf({FilterType::hard, 3}), kernelOf(pcf(3)), kernelOf(pcf(7))}) {
      RC_ASSERT(worstAcne(normal, texelSize, phase, kernel.reach) < 1e-12);
    }
  }));
}

TEST(Bias, H4_TheOffsetIsNoLargerThanTheSteepestPlaneNeeds) {
  // A plane that rises along a texel's diagonal, with centres exactly at the kernel's reach.
  const double tilt = glm::radians(60.0);
  const glm::dvec3 normal(std::sin(tilt) * std::sqrt(0.5), std::sin(tilt) * std::sqrt(0.5), std::cos(tilt));
  EXPECT_NEAR(worstAcne(normal, {0.1, 0.1}, {0, 0}, 3), 0.0, 1e-12);
  EXPECT_NEAR(normalOffset(3, {0.1, 0.1}), 0.1 * 3 * std::sqrt(2.0), 1e-15);
}

TEST(Bias, H4_DepthBiasCoversTheRoundingOfFloatTransforms) {
  EXPECT_TRUE(rc::check([](unsigned seed) {
    Dice dice(seed);
    const double magnitude = std::pow(10, dice.between(-1, 4));
    const double extent = magnitude * std::pow(10, dice.between(-3, 0.3));
    const glm::dvec3 direction = dice.direction();
    const double nearest = dice.between(-1, 1) * magnitude;
    const auto inFloat = [&](const glm::vec3& p) {
      const glm::vec4 row(glm::vec3(direction / extent), static_cast<float>(-nearest / extent));
      return row.x * p.x + row.y * p.y + row.z * p.z + row.w;
    };
    const double bias = depthBias(magnitude, extent);
    for (int i = 0; i < 100; ++i) {
      const glm::dvec3 point = dice.direction() * magnitude;
      const double exact = (glm::dot(direction, point) - nearest) / extent;
      const double error = std::abs(inFloat(glm::vec3(point)) - exact);
      RC_ASSERT(2 * error < bias); // once in the map, once at the receiver
    }
  }));
}

} // namespace
} // namespace gnomon
