#include "renderer/core/light.h"

#include <gtest/gtest.h>

namespace gnomon {
namespace {

void expectNear(const glm::dvec3& a, const glm::dvec3& b) {
  EXPECT_LT(glm::length(a - b), 1e-12) << a.x << ' ' << a.y << ' ' << a.z;
}

TEST(LightDirection, TheSunStandsWhereItsAnglesSay) {
  Light light;
  light.sun = Sun{90, 0};
  expectNear(directionOf(light), {-1, 0, 0}); // from the east
  light.sun = Sun{0, 0};
  expectNear(directionOf(light), {0, 0, 1}); // from the north
  light.sun = Sun{217, 90};
  expectNear(directionOf(light), {0, -1, 0}); // from above
}

TEST(LightDirection, ADirectionOfAnyLengthIsMadeUnit) {
  Light light;
  light.direction = Vec3{0, -1e-200, 0};
  expectNear(directionOf(light), {0, -1, 0});
  light.direction = Vec3{1e200, 0, 0};
  expectNear(directionOf(light), {1, 0, 0});
}

TEST(BlackBody, X14_DaylightIsAboutWhite) {
  const glm::dvec3 color = blackBodyColor(6500);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(color[i], 1.0, 0.06) << i;
}

/// Illuminant A is a black body of 2856 K: x 0.44757, y 0.40745 (CIE 15), brought to sRGB's primaries here.
TEST(BlackBody, X14_AnIncandescentLampHasTheColorOfIlluminantA) {
  const glm::dvec3 color = blackBodyColor(2856);
  const glm::dvec3 xyz(0.4124564 * color.r + 0.3575761 * color.g + 0.1804375 * color.b,
                       0.2126729 * color.r + 0.7151522 * color.g + 0.0721750 * color.b,
                       0.0193339 * color.r + 0.1191920 * color.g + 0.9503041 * color.b);
  const double sum = xyz.x + xyz.y + xyz.z;
  EXPECT_NEAR(xyz.x / sum, 0.44757, 5e-4);
  EXPECT_NEAR(xyz.y / sum, 0.40745, 5e-4);
}

TEST(BlackBody, X14_HotterIsBluerAndNeverBrighter) {
  double before = 1e9;
  for (int kelvin = 1000; kelvin <= 15000; kelvin += 50) {
    const glm::dvec3 color = blackBodyColor(kelvin);
    EXPECT_NEAR(luminanceOf(color), 1.0, 1e-12) << kelvin;
    for (int i = 0; i < 3; ++i) EXPECT_GE(color[i], 0.0) << kelvin;
    EXPECT_LT(color.r / color.g, before) << kelvin;
    before = color.r / color.g;
  }
  double blueness = -1;
  for (int kelvin = 2000; kelvin <= 15000; kelvin += 50) {
    const glm::dvec3 color = blackBodyColor(kelvin);
    EXPECT_GT(color.b / color.g, blueness) << kelvin;
    blueness = color.b / color.g;
  }
}

} // namespace
} // namespace gnomon
