// The maps of an environment that surfaces are lit by, against sums over all of its texels.
#include "renderer/environment/prefilter.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "renderer/environment/environment_cells.h"
#include "renderer/shaders/shared/functions.h"
#include "tests/renderer/environment/made_maps.h"

namespace gnomon {
namespace {

using testing::noisyMap;
using testing::oneTexelMap;
using testing::spreadDirections;
using testing::texelDirection;
using testing::uniformMap;

float brightest(const glm::vec3& color) {
  return std::max({color.x, color.y, color.z});
}

/// The mean of a map over a weight of the cosine to a direction.
template <class Weight>
glm::dvec3 meanOver(const EnvironmentMap& map, const glm::dvec3& direction, const Weight& weight) {
  glm::dvec3 sum(0);
  double all = 0;
  for (int y = 0; y < map.height; ++y) {
    const double solidAngle = texelSolidAngle(map, y);
    for (int x = 0; x < map.width; ++x) {
      const double share = solidAngle * weight(glm::dot(direction, texelDirection(map, x, y)));
      sum += share * glm::dvec3(map.at(x, y));
      all += share;
    }
  }
  return sum / all;
}

/// GGX along its axis, times the cosine.
double lobe(double cosine, double roughness) {
  const double a2 = std::pow(roughness, 4);
  const double d = a2 + (1 - a2) * (1 - cosine) / 2;
  return cosine > 0 ? cosine / (d * d) : 0;
}

TEST(Prefilter, AUniformMapStaysUniform) {
  const glm::vec3 radiance(0.25f, 2, 900);
  for (const int height : {1, 7, 512, 700}) {
    const PrefilteredEnvironment made = prefiltered(uniformMap(height, radiance));
    for (const glm::vec3& direction : spreadDirections(500)) {
      for (const float roughness : {0.0f, 0.1f, 0.35f, 0.8f, 1.0f}) {
        const glm::vec3 seen = shared::environmentRadiance(made.texels.data(), direction, roughness);
        EXPECT_LT(brightest(glm::abs(seen / radiance - 1.0f)), 2e-3f) << height << ' ' << roughness;
      }
      const glm::vec3 diffuse = shared::environmentIrradiance(made.texels.data(), direction);
      EXPECT_LT(brightest(glm::abs(diffuse / radiance - 1.0f)), 1e-4f) << height;
    }
    EXPECT_LT(glm::length(made.mean / glm::dvec3(radiance) - 1.0), 1e-4);
  }
}

TEST(Prefilter, OneBrightTexelLightsAsADirectionalLight) {
  struct Place {
    int x, y;
  };
  for (const Place place : {Place{3, 0}, Place{100, 40}, Place{511, 255}, Place{700, 300}, Place{1023, 510}}) {
    const EnvironmentMap map = oneTexelMap(512, place.x, place.y, glm::vec3(2e4f, 1e4f, 5e3f));
    const PrefilteredEnvironment made = prefiltered(map);
    const glm::vec3 arriving = map.at(place.x, place.y) * float(texelSolidAngle(map, place.y) / glm::pi<double>());
    const glm::vec3 towards(texelDirection(map, place.x, place.y));
    float worst = 0;
    for (const glm::vec3& normal : spreadDirections(20000)) {
      const glm::vec3 expected = arriving * std::max(0.0f, glm::dot(normal, towards));
      const glm::vec3 found = shared::environmentIrradiance(made.texels.data(), normal);
      worst = std::max(worst, brightest(glm::abs(found - expected) / arriving));
    }
    std::printf("texel %d %d: off by %.4f of the most\n", place.x, place.y, double(worst));
    EXPECT_LT(worst, 0.01f);
  }
}

TEST(Prefilter, LevelsAreMeansOverTheLobe) {
  const EnvironmentMap map = noisyMap(256);
  const PrefilteredEnvironment made = prefiltered(map);
  for (int level = 1; level < GNOMON_ENVIRONMENT_LEVELS; ++level) {
    const double roughness = double(level) / (GNOMON_ENVIRONMENT_LEVELS - 1);
    double square = 0, mean = 0;
    const std::vector<CellLevel> cells = cellLevels(map);
    const auto directions = spreadDirections(100);
    for (const glm::vec3& direction : directions) {
      const glm::dvec3 expected =
          meanOver(map, glm::dvec3(direction), [&](double cosine) { return lobe(cosine, roughness); });
      const glm::dvec3 found(meanOverLobe(cells, direction, float(roughness * roughness)));
      square += glm::dot(found - expected, found - expected);
      mean += glm::dot(expected, expected);
    }
    const double off = std::sqrt(square / mean);
    std::printf("roughness %.3f: off by %.4f\n", roughness, off);
    EXPECT_LT(off, 0.02) << roughness;
  }
}

/// A map whose light changes slowly: what is looked up between texels and levels is near to the sum.
TEST(Prefilter, LookupsAreNearToTheSumAtAnyRoughness) {
  EnvironmentMap map = uniformMap(128, glm::vec3(0));
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      const glm::dvec3 d = texelDirection(map, x, y);
      map.texels[std::size_t(y * map.width + x)] =
          glm::vec3(1 + d.y, 1.5 + std::sin(3 * d.x), 0.3 + std::exp(4 * glm::dot(d, glm::dvec3(0.6, 0.48, 0.64)) - 4));
    }
  }
  const PrefilteredEnvironment made = prefiltered(map);
  for (const double roughness : {0.2, 0.43, 0.5, 0.65, 0.9, 1.0}) {
    double worst = 0;
    for (const glm::vec3& direction : spreadDirections(60)) {
      const glm::dvec3 expected =
          meanOver(map, glm::dvec3(direction), [&](double cosine) { return lobe(cosine, roughness); });
      const glm::vec3 found = shared::environmentRadiance(made.texels.data(), direction, float(roughness));
      worst = std::max(worst, double(brightest(glm::abs(found - glm::vec3(expected)))));
    }
    std::printf("roughness %.2f: off by at most %.4f\n", roughness, worst);
    EXPECT_LT(worst, 0.02) << roughness;
  }
  for (const glm::vec3& direction : spreadDirections(60)) {
    const glm::dvec3 expected =
        meanOver(map, glm::dvec3(direction), [](double cosine) { return std::max(cosine, 0.0); });
    const glm::vec3 found = shared::environmentIrradiance(made.texels.data(), direction);
    EXPECT_LT(brightest(glm::abs(found - glm::vec3(expected))), 0.003f);
  }
}

TEST(Prefilter, WhatIsNearlySmoothIsHardlyBlurred) {
  EnvironmentMap map = uniformMap(512, glm::vec3(1));
  for (std::size_t i = map.texels.size() / 2; i < map.texels.size(); ++i) map.texels[i] = glm::vec3(0);
  const PrefilteredEnvironment made = prefiltered(map);
  const double degrees = glm::pi<double>() / 180;
  for (const double turn : {0.3, 1.1, 2.6, 4.4}) {
    const auto shown = [&](double elevation) {
      const double across = std::cos(elevation * degrees), up = std::sin(elevation * degrees);
      const glm::vec3 direction(across * std::cos(turn), up, across * std::sin(turn));
      return shared::environmentRadiance(made.texels.data(), direction, 0.05f).x;
    };
    EXPECT_GT(shown(1.5), 0.95f) << "0.99 of the lobe lies above the horizon";
    EXPECT_LT(shown(-1.5), 0.05f);
  }
}

/// One step across an edge of the octahedron changes a lookup by no more than a step elsewhere may.
TEST(Prefilter, NoSeamShowsAtTheEdgesOfTheOctahedron) {
  EnvironmentMap map = noisyMap(512);
  for (glm::vec3& texel : map.texels) texel = glm::min(texel, glm::vec3(1));
  const PrefilteredEnvironment made = prefiltered(map);
  for (int i = 0; i < 2000; ++i) {
    const double turn = 2 * glm::pi<double>() * (i + 0.37) / 2000;
    const glm::dvec3 equator(std::cos(turn), std::sin(turn), 0);
    const glm::dvec3 meridian =
        i % 2 == 0 ? glm::dvec3(std::cos(turn), 0, std::sin(turn)) : glm::dvec3(0, std::cos(turn), std::sin(turn));
    const glm::dvec3 acrossMeridian = i % 2 == 0 ? glm::dvec3(0, 1e-5, 0) : glm::dvec3(1e-5, 0, 0);
    struct Edge {
      glm::dvec3 place, step;
    };
    for (const Edge& edge : {Edge{equator, glm::dvec3(0, 0, 1e-5)}, Edge{meridian, acrossMeridian}}) {
      for (const float roughness : {0.0f, 0.143f, 0.5f, 1.0f}) {
        const auto at = [&](double side) {
          return shared::environmentRadiance(made.texels.data(), glm::vec3(edge.place + side * edge.step), roughness);
        };
        EXPECT_LT(brightest(glm::abs(at(1) - at(-1))), 0.02f) << turn << ' ' << roughness;
      }
    }
  }
}

TEST(Prefilter, AMapOfAnotherSizeKeepsItsLight) {
  const EnvironmentMap map = noisyMap(300);
  const EnvironmentMap smaller = resampled(map, 128);
  EXPECT_EQ(smaller.width, 128);
  EXPECT_EQ(smaller.height, 64);
  const auto mean = [](const EnvironmentMap& of) { return meanOver(of, {0, 1, 0}, [](double) { return 1.0; }); };
  EXPECT_LT(glm::length(mean(smaller) / mean(map) - 1.0), 2e-3);
  EXPECT_EQ(resampled(map, 600).texels, map.texels);
  EXPECT_LT(glm::length(mean(resampled(map, 700)) / mean(map) - 1.0), 2e-3);
}

TEST(Prefilter, AnyNumberOfThreadsMakesTheSame) {
  const EnvironmentMap map = noisyMap(200);
  const PrefilteredEnvironment many = prefiltered(map);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(prefiltered(map).texels, many.texels);
}

} // namespace
} // namespace gnomon
