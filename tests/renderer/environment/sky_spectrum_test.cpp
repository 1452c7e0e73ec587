#include "renderer/environment/sky_spectrum.h"

#include <gtest/gtest.h>

#include "renderer/core/light.h"

namespace gnomon {
namespace {

Spectrum all(float share) {
  Spectrum spectrum;
  spectrum.fill(share);
  return spectrum;
}

TEST(SkySpectrum, TheWholeSunHasItsIlluminanceAndIsNearlyWhite) {
  const glm::dvec3 color = sunlightColor(all(1));
  EXPECT_NEAR(luminanceOf(color), kSolarLux, 1e-4 * kSolarLux);
  EXPECT_NEAR(luminanceOf(sunlightColor(all(0.25))), kSolarLux / 4, 1e-4 * kSolarLux);
  // A black body of 5778 K, by a formula of its own.
  const glm::dvec3 same = blackBodyColor(5778) * kSolarLux;
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(color[i], same[i], 0.02 * kSolarLux) << i;
}

TEST(SkySpectrum, BandsGoFromBlueToRed) {
  const auto only = [](std::size_t band) {
    Spectrum spectrum{};
    spectrum[band] = 1;
    return sunlightColor(spectrum);
  };
  EXPECT_GT(only(1).b, 10 * only(1).g);
  EXPECT_GT(only(4).g, only(4).b);
  EXPECT_GT(only(6).r, 5 * only(6).g);
}

TEST(SkySpectrum, PureColorsArePaledAndKeepTheirLuminance) {
  const glm::dvec3 pure(120, 40, -6), paled = withinSrgb(pure);
  EXPECT_NEAR(luminanceOf(paled), luminanceOf(pure), 1e-9);
  EXPECT_NEAR(paled.b, 0, 1e-9);
  EXPECT_LT(paled.r, pure.r);
  EXPECT_EQ(withinSrgb({3, 2, 1}), glm::dvec3(3, 2, 1));
  EXPECT_EQ(withinSrgb({-1, -1, -1}), glm::dvec3(0));
}

} // namespace
} // namespace gnomon
