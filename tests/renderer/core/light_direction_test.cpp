#include "renderer/core/light_direction.h"

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

} // namespace
} // namespace gnomon
