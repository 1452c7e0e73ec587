// What surfaces reflect of an environment (renderer/shaders/shared/environment.h).
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include "renderer/environment/prefilter.h"
#include "renderer/shaders/shared/functions.h"
#include "tests/renderer/environment/made_maps.h"

namespace gnomon::shared {
namespace {

using gnomon::testing::uniformMap;

const vec2 kNoTurn(1, 0);

struct Shown {
  vec3 color{1};
  float metallic = 0;
  float roughness = 0.5f;
  vec3 toEye{0, 1, 0};
  vec3 normal{0, 1, 0};
  vec3 face{0, 1, 0};
  vec4 arriving{1};

  vec3 in(const PrefilteredEnvironment& environment, const vec2& turn = kNoTurn) const {
    const SurfacePoint s = surfacePoint(color, metallic, roughness, normal, toEye);
    return environmentReflected(environment.texels.data(), turn, s, color, metallic, roughness, face, arriving);
  }
};

const PrefilteredEnvironment& white() {
  static const PrefilteredEnvironment made = prefiltered(uniformMap(16, vec3(1)));
  return made;
}

TEST(EnvironmentShading, WhiteIsWhiteInAWhiteFurnace) {
  for (float metallic = 0; metallic <= 1; metallic += 0.125f) {
    for (float roughness = 0; roughness <= 1; roughness += 0.0625f) {
      for (const float up : {1.0f, 0.8f, 0.4f, 0.1f, 0.01f}) {
        const Shown shown{.metallic = metallic, .roughness = roughness, .toEye = vec3(sqrt(1 - up * up), up, 0)};
        const vec3 seen = shown.in(white());
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[c], 1, 0.01f) << metallic << ' ' << roughness << ' ' << up;
      }
    }
  }
}

/// The integrals over all directions to the light that sharesOfLobe stands for, over half vectors as GGX spreads them.
glm::dvec2 integratedLobe(double alpha, double nv) {
  constexpr int kRings = 256, kSpokes = 64;
  const double a2 = alpha * alpha, across = std::sqrt(1 - nv * nv);
  glm::dvec2 sum(0);
  for (int ring = 0; ring < kRings; ++ring) {
    const double u = (ring + 0.5) / kRings;
    const double nh = std::sqrt((1 - u) / (1 + (a2 - 1) * u));
    for (int spoke = 0; spoke < kSpokes; ++spoke) {
      const double vh =
          across * std::sqrt(1 - nh * nh) * std::cos(std::numbers::pi * (spoke + 0.5) / kSpokes) + nv * nh;
      const double nl = 2 * vh * nh - nv;
      if (vh <= 0 || nl <= 0) continue;
      const double masking = 0.5 / (nl * std::sqrt(nv * nv * (1 - a2) + a2) + nv * std::sqrt(nl * nl * (1 - a2) + a2));
      const double reflected = 4 * masking * nl * vh / nh, fresnel = std::pow(1 - std::min(vh, 1.0), 5);
      sum += reflected * glm::dvec2(1 - fresnel, fresnel);
    }
  }
  return sum / double(kRings * kSpokes);
}

TEST(EnvironmentShading, SharesOfTheLobeAreItsIntegrals) {
  double squares = 0;
  int count = 0;
  for (double roughness = 0.05; roughness <= 1; roughness += 0.05) {
    for (double nv = 0.1; nv <= 1; nv += 0.05) {
      const double alpha = roughness * roughness;
      const glm::dvec2 off =
          glm::dvec2(sharesOfLobe(static_cast<float>(alpha), static_cast<float>(nv))) - integratedLobe(alpha, nv);
      EXPECT_NEAR(off.x, 0, 0.04) << roughness << ' ' << nv;
      EXPECT_NEAR(off.y, 0, 0.03) << roughness << ' ' << nv;
      squares += glm::dot(off, off);
      ++count;
    }
  }
  EXPECT_LT(std::sqrt(squares / count), 0.01);
}

TEST(EnvironmentShading, RoughLobesTurnToTheNormal) {
  const vec3 up(0, 1, 0), toEye = normalize(vec3(1, 1, 0));
  const auto middle = [&](float roughness) {
    const SurfacePoint s = surfacePoint(vec3(1), 1, roughness, up, toEye);
    return middleOfLobe(s, mirroredBy(s));
  };
  EXPECT_NEAR(middle(0).x, -toEye.x, 1e-5f);
  EXPECT_NEAR(middle(1).y, 1, 1e-6f);
  EXPECT_LT(middle(0.5f).x, middle(0.8f).x);
}

TEST(EnvironmentShading, ColoredMetalLosesNoMoreThanItsColorTakes) {
  const Shown smooth{.color = vec3(0.9f, 0.5f, 0.1f), .metallic = 1, .roughness = 0};
  const Shown rough{.color = smooth.color, .metallic = 1, .roughness = 1};
  const vec3 once = smooth.in(white()), often = rough.in(white());
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(once[c], smooth.color[c], 0.01f);
  for (int c = 0; c < 3; ++c) {
    EXPECT_LT(often[c], once[c]) << "light that is reflected more often takes on more of the color";
    EXPECT_GT(often[c], 0.3f * once[c]) << "what is reflected at once";
  }
  EXPECT_GT(often.x / often.z, once.x / once.z);
}

TEST(EnvironmentShading, SharesOfDiffuseAndMirroredLightAreApart) {
  const Shown open{.color = vec3(0.5f), .metallic = 0.3f};
  Shown none = open, red = open, mirrored = open;
  none.arriving = vec4(0);
  red.arriving = vec4(1, 0, 0, 0);
  mirrored.arriving = vec4(0, 0, 0, 1);
  EXPECT_EQ(none.in(white()), vec3(0));
  EXPECT_GT(red.in(white()).x, 0.2f);
  EXPECT_EQ(red.in(white()).y, 0);
  EXPECT_NEAR(red.in(white()).x + mirrored.in(white()).x, open.in(white()).x, 1e-5f);
}

TEST(EnvironmentShading, WhatIsMirroredBelowTheTriangleFades) {
  const vec3 toEye = normalize(vec3(1, 0.5f, 0));
  const auto shownWith = [&](float lean) {
    return Shown{.metallic = 1, .roughness = 0.1f, .toEye = toEye, .normal = normalize(vec3(-lean, 1, 0))}.in(white());
  };
  EXPECT_NEAR(shownWith(0).x, 1, 0.01f);
  EXPECT_NEAR(shownWith(0.2f).x, 1, 0.01f) << "still above the triangle";
  EXPECT_LT(shownWith(0.45f).x, 0.7f);
  EXPECT_LT(shownWith(0.5f).x, 0.85f * shownWith(0.45f).x);
  const Shown below{.metallic = 1, .roughness = 0.1f, .toEye = vec3(1, 0, 0), .normal = vec3(0.7071f, -0.7071f, 0)};
  EXPECT_LT(below.in(white()).x, 0.1f) << "straight down";
}

TEST(EnvironmentShading, ATurnTurnsTheLight) {
  EnvironmentMap map = uniformMap(64, vec3(0));
  for (int y = 16; y < 48; ++y) {
    for (int x = 48; x < 80; ++x) map.texels[std::size_t(y * 128 + x)] = vec3(1); // about +X
  }
  const PrefilteredEnvironment made = prefiltered(map);
  const auto lit = [&](const vec3& normal, const vec2& turn) {
    return Shown{.roughness = 1, .toEye = normal, .normal = normal, .face = normal}.in(made, turn).x;
  };
  EXPECT_GT(lit({1, 0, 0}, kNoTurn), 2 * lit({0, 0, 1}, kNoTurn));
  // What is +Z of the world is +X of the map.
  const vec2 quarter(0, 1);
  EXPECT_NEAR(lit({0, 0, 1}, quarter), lit({1, 0, 0}, kNoTurn), 1e-4f);
  EXPECT_NEAR(lit({0, 1, 0}, quarter), lit({0, 1, 0}, kNoTurn), 1e-4f);
}

} // namespace
} // namespace gnomon::shared
