#include <cmath>
#include <glm/gtc/constants.hpp>
#include <gtest/gtest.h>
#include <vector>

#include "renderer/shadow/tile_space.h"
#include "tests/renderer/shadow/random_plan.h"

namespace gnomon {
namespace {

/// Largest departure from an orthonormal right-handed basis that looks along `direction`; NaN fails every comparison.
double fault(const LightBasis& b, const glm::dvec3& direction) {
  return std::max({std::abs(glm::length(b.right) - 1), std::abs(glm::length(b.up) - 1),
                   std::abs(glm::dot(b.right, b.up)), glm::length(b.direction - direction),
                   glm::length(glm::cross(b.right, b.up) + direction)}) +
         0.0 * (b.right.x + b.right.y + b.right.z + b.up.x + b.up.y + b.up.z);
}

/// Radians between the frames of two directions.
double turnBetween(const glm::dvec3& a, const glm::dvec3& b) {
  const glm::dmat3 difference = glm::transpose(lightBasis(a).lightFromWorld()) * lightBasis(b).lightFromWorld();
  const glm::dmat3 identity(1.0);
  double sum = 0;
  for (int i = 0; i < 3; ++i) sum += glm::dot(difference[i] - identity[i], difference[i] - identity[i]);
  return std::sqrt(sum / 2); // |R - 1| of a small turn is sqrt(2) times its angle
}

TEST(LightBasis, M3_X25_IsOrthonormalForAnyDirection) {
  EXPECT_TRUE(rc::check([](unsigned seed) {
    const glm::dvec3 direction = Dice(seed).direction();
    RC_ASSERT(fault(lightBasis(direction), direction) < 1e-14);
  }));
}

TEST(LightBasis, M3_X25_IsOrthonormalAtAndAroundTheAxesAndTheSpin) {
  // The spin: light that shines up from 11 degrees below the horizon, azimuth 37.3 + 180 degrees.
  const double azimuth = glm::radians(37.3);
  const double elevation = glm::radians(11.0);
  const glm::dvec3 spin(std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
                        -std::cos(azimuth) * std::cos(elevation));
  const std::vector<glm::dvec3> centers{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0},
                                        {0, 0, 1}, {0, 0, -1}, spin,      -spin};
  Dice dice(7);
  for (const glm::dvec3& center : centers) {
    EXPECT_LT(fault(lightBasis(center), center), 1e-14);
    for (double distance = 1e-17; distance < 0.1; distance *= 3) {
      const glm::dvec3 direction = glm::normalize(center + distance * dice.direction());
      EXPECT_LT(fault(lightBasis(direction), direction), 1e-14) << distance;
    }
  }
}

TEST(LightBasis, M3_X25_RollsLittleWhereALightTurnsThroughTheVertical) {
  for (const double sign : {-1.0, 1.0}) {
    const glm::dvec3 vertical(0, sign, 0);
    for (const double angle : {1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2}) {
      for (int side = 0; side < 16; ++side) {
        const double azimuth = side * glm::pi<double>() / 8;
        const glm::dvec3 tilted(std::sin(angle) * std::cos(azimuth), sign * std::cos(angle),
                                std::sin(angle) * std::sin(azimuth));
        const glm::dvec3 opposite(-tilted.x, tilted.y, -tilted.z);
        EXPECT_LT(turnBetween(vertical, tilted), 2 * angle);
        EXPECT_LT(turnBetween(tilted, opposite), 4 * angle);
      }
    }
  }
}

TEST(LightBasis, X25_TurnsAboutAsMuchAsAnySunDoes) {
  // Suns at or above the horizon are at least 11 degrees from the spin, where the roll is tan(84.5 degrees) at most.
  for (double azimuth = 0; azimuth < 360; azimuth += 5) {
    for (double elevation = 0; elevation <= 90; elevation += 5) {
      const auto sun = [](double az, double el) {
        az = glm::radians(az);
        el = glm::radians(el);
        return -glm::dvec3(std::sin(az) * std::cos(el), std::sin(el), -std::cos(az) * std::cos(el));
      };
      const double step = 0.001;
      EXPECT_LT(turnBetween(sun(azimuth, elevation), sun(azimuth + step, elevation)), 12 * glm::radians(step));
      EXPECT_LT(turnBetween(sun(azimuth, elevation), sun(azimuth, elevation - step)), 12 * glm::radians(step));
    }
  }
}

} // namespace
} // namespace gnomon
