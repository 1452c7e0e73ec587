#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <numbers>
#include <vector>

#include "renderer/shaders/shared/functions.h"

namespace gnomon::shared {
namespace {

using Weight = std::function<double(double cosine)>;
using Radiance = std::function<double(const glm::dvec3& direction)>;

/// Directions that are spread evenly (a spherical Fibonacci lattice).
std::vector<glm::dvec3> directions(int count) {
  std::vector<glm::dvec3> all;
  for (int i = 0; i < count; ++i) {
    const double up = 1 - 2 * (i + 0.5) / count;
    const double turn = std::numbers::pi * (1 + std::sqrt(5.0)) * (i + 0.5);
    const double across = std::sqrt(1 - up * up);
    all.emplace_back(across * std::cos(turn), up, across * std::sin(turn));
  }
  return all;
}

/// The mean of `radiance` over directions before `axis`, by `weight` of their cosine to it.
double meanAround(const glm::dvec3& axis, const Radiance& radiance, const Weight& weight) {
  static const std::vector<glm::dvec3> all = directions(40'000);
  double sum = 0;
  double weights = 0;
  for (const glm::dvec3& direction : all) {
    const double cosine = glm::dot(axis, direction);
    if (cosine <= 0) continue;
    sum += weight(cosine) * radiance(direction);
    weights += weight(cosine);
  }
  return sum / weights;
}

/// A GGX lobe seen along its axis: half vectors at half the angle; the density of the mirrored ones over a solid angle
/// is D / 4, weighted by the cosine (Karis, "Real Shading in Unreal Engine 4", 2013).
Weight lobeOf(double roughness) {
  const double a2 = std::pow(roughness, 4);
  return [a2](double cosine) {
    const double halfSquared = (1 + cosine) / 2;
    const double d = halfSquared * (a2 - 1) + 1;
    return cosine / (d * d);
  };
}

double byCosine(double cosine) {
  return cosine;
}

glm::dvec3 axisAt(double up) {
  return {std::sqrt(1 - up * up), up, 0};
}

double evenRadiance(const glm::dvec3& direction) {
  return double{radianceOfEvenStudio(static_cast<float>(direction.y), 0.0f)};
}

double lampsRadiance(const glm::dvec3& direction) {
  return double{radianceOfLamps(glm::vec3(direction), 0.0f)};
}

TEST(Surroundings, IrradianceOfTheEvenStudioIsItsOverAHemisphere) {
  for (const double up : {-1.0, -0.5, 0.0, 0.5, 1.0}) {
    EXPECT_NEAR(irradianceOfEvenStudio(static_cast<float>(up)), meanAround(axisAt(up), evenRadiance, byCosine), 0.01)
        << up;
  }
}

TEST(Surroundings, AWhiteFloorShowsAmbientAsItIs) {
  EXPECT_NEAR(irradianceOfEvenStudio(1), 1.0f, 0.01f);
  EXPECT_NEAR(irradianceOfLamps(glm::vec3(0, 1, 0)), 1.0f, 0.01f);
}

TEST(Surroundings, ARoughMirrorSeesWhatItsLobeCoversOfTheEvenStudio) {
  for (const double roughness : {0.2, 0.4, 0.6, 0.8, 1.0}) {
    for (const double up : {-1.0, -0.6, -0.3, 0.0, 0.3, 0.6, 0.85, 1.0}) {
      EXPECT_NEAR(radianceOfEvenStudio(static_cast<float>(up), static_cast<float>(roughness)),
                  meanAround(axisAt(up), evenRadiance, lobeOf(roughness)), 0.12)
          << up << " " << roughness;
    }
  }
}

TEST(Surroundings, IrradianceOfLampsIsTheirsOverAHemisphere) {
  for (const glm::dvec3& normal : directions(60)) {
    EXPECT_NEAR(irradianceOfLamps(glm::vec3(normal)), meanAround(normal, lampsRadiance, byCosine), 0.04);
  }
}

TEST(Surroundings, ARoughMirrorSeesWhatItsLobeCoversOfLamps) {
  const std::vector<glm::dvec3> axes = directions(150);
  for (const double roughness : {0.1, 0.2, 0.4, 0.6, 0.8, 1.0}) {
    double squares = 0;
    for (const glm::dvec3& axis : axes) {
      const double shown = double{radianceOfLamps(glm::vec3(axis), static_cast<float>(roughness))};
      const double exact = meanAround(axis, lampsRadiance, lobeOf(roughness));
      EXPECT_NEAR(shown, exact, 0.25) << roughness;
      squares += (shown - exact) * (shown - exact);
    }
    EXPECT_LT(std::sqrt(squares / static_cast<double>(axes.size())), 0.05) << roughness;
  }
}

TEST(Surroundings, LampsTurnWithTheSurroundings) {
  const glm::vec2 quarter(0, 1);
  EXPECT_GT(radianceOfStudio(glm::vec3(0.7686f, 0.5299f, 0.3584f), glm::vec2(1, 0), 1, 0), 2.0f);
  EXPECT_GT(radianceOfStudio(glm::vec3(-0.3584f, 0.5299f, 0.7686f), quarter, 1, 0), 2.0f);
  EXPECT_LT(radianceOfStudio(glm::vec3(0.7686f, 0.5299f, 0.3584f), glm::vec2(-1, 0), 1, 0), 1.0f) << "a half turn";
}

TEST(Surroundings, NothingIsBlackAndAboveIsBrighterThanBelow) {
  for (const float roughness : {0.0f, 0.5f, 1.0f}) {
    for (float up = -1; up <= 1; up += 0.125f) EXPECT_GT(radianceOfEvenStudio(up, roughness), 0.3f);
    EXPECT_GT(radianceOfEvenStudio(1, roughness), 2 * radianceOfEvenStudio(-1, roughness));
  }
  for (const glm::dvec3& direction : directions(500)) {
    for (const float roughness : {0.0f, 0.5f, 1.0f}) {
      EXPECT_GT(radianceOfLamps(glm::vec3(direction), roughness), 0.15f);
    }
  }
}

} // namespace
} // namespace gnomon::shared
