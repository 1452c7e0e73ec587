#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include "renderer/shaders/shared/functions.h"

namespace gnomon::shared {
namespace {

/// The mean of the surroundings over directions around an axis at that height, by `weight` of the cosine to the axis.
template <class Weight>
double meanAround(double height, const Weight& weight) {
  constexpr int kRings = 400;
  constexpr int kAround = 64;
  const double across = std::sqrt(1 - height * height);
  double sum = 0;
  double weights = 0;
  for (int ring = 0; ring < kRings; ++ring) {
    const double cosine = (ring + 0.5) / kRings;
    const double sine = std::sqrt(1 - cosine * cosine);
    for (int i = 0; i < kAround; ++i) {
      const double turn = 2 * std::numbers::pi * (i + 0.5) / kAround;
      const double up = cosine * height + sine * across * std::cos(turn);
      sum += weight(cosine) * static_cast<double>(radianceAround(static_cast<float>(up), 0.0f));
      weights += weight(cosine);
    }
  }
  return sum / weights;
}

TEST(Surroundings, IrradianceIsTheirsOverAHemisphere) {
  for (const double up : {-1.0, -0.5, 0.0, 0.5, 1.0}) {
    EXPECT_NEAR(irradianceAround(static_cast<float>(up)), meanAround(up, [](double cosine) { return cosine; }), 0.01)
        << up;
  }
}

TEST(Surroundings, AWhiteFloorShowsAmbientAsItIs) {
  EXPECT_NEAR(irradianceAround(1), 1.0f, 0.01f);
}

TEST(Surroundings, ARoughMirrorSeesWhatItsLobeCovers) {
  for (const double roughness : {0.2, 0.4, 0.6, 0.8, 1.0}) {
    const double a2 = std::pow(roughness, 4);
    // A GGX lobe seen along its axis: half vectors at half the angle; the density of the mirrored ones over a solid
    // angle is D / 4, weighted by the cosine (Karis, "Real Shading in Unreal Engine 4", 2013).
    const auto lobe = [&](double cosine) {
      const double halfSquared = (1 + cosine) / 2;
      const double d = halfSquared * (a2 - 1) + 1;
      return cosine / (d * d);
    };
    for (const double up : {-1.0, -0.6, -0.3, 0.0, 0.3, 0.6, 0.85, 1.0}) {
      EXPECT_NEAR(radianceAround(static_cast<float>(up), static_cast<float>(roughness)), meanAround(up, lobe), 0.12)
          << up << " " << roughness;
    }
  }
}

TEST(Surroundings, NothingIsBlackAndAboveIsBrighterThanBelow) {
  for (const float roughness : {0.0f, 0.5f, 1.0f}) {
    for (float up = -1; up <= 1; up += 0.125f) EXPECT_GT(radianceAround(up, roughness), 0.3f);
    EXPECT_GT(radianceAround(1, roughness), 2 * radianceAround(-1, roughness));
  }
}

} // namespace
} // namespace gnomon::shared
