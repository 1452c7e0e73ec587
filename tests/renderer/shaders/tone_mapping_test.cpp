// Tone mapping, a number at a time, against what is published of each curve.
#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <random>

#include "renderer/device/shader_data.h"
#include "renderer/shaders/shared/functions.h"
#include "tests/support/tone_curves.h"

namespace gnomon {
namespace {

using testing::publishedTone;

constexpr std::array kTones{ToneMapping::aces, ToneMapping::neutral, ToneMapping::agx, ToneMapping::none};

glm::dvec3 mapped(ToneMapping tone, const glm::dvec3& light) {
  return glm::dvec3(shared::toneMapped(glm::vec3(light), toneOf(tone, true)));
}

double largest(const glm::dvec3& v) {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

/// Colors of 2^-12 to 2^8, all hues.
std::vector<glm::dvec3> colors() {
  std::mt19937 random(42);
  std::uniform_real_distribution<double> share(0, 1), stops(-12, 8);
  std::vector<glm::dvec3> made(20'000);
  for (glm::dvec3& color : made) {
    const double brightness = std::exp2(stops(random));
    for (int i = 0; i < 3; ++i) color[i] = brightness * share(random);
  }
  return made;
}

TEST(ToneMapping, NeutralAndAgxGiveWhatIsPublished) {
  for (const glm::dvec3& color : colors()) {
    for (const ToneMapping tone : {ToneMapping::neutral, ToneMapping::agx}) {
      EXPECT_LT(largest(mapped(tone, color) - publishedTone(tone, color)), 2e-5)
          << toneOf(tone, true) << " " << color.x << " " << color.y << " " << color.z;
    }
  }
}

TEST(ToneMapping, NeutralTakesAwayWhatASmoothSurfaceReflectsAndNoMore) {
  for (const glm::dvec3 color :
       {glm::dvec3(0.08), glm::dvec3(0.8), glm::dvec3(0.5, 0.1, 0.79), glm::dvec3(0.2, 0.8, 0.3)})
    EXPECT_LT(largest(mapped(ToneMapping::neutral, color) - (color - 0.04)), 1e-6);
}

TEST(ToneMapping, NeutralCanBeUndone) {
  for (const glm::dvec3& color : colors()) {
    const glm::dvec3 shown = mapped(ToneMapping::neutral, color);
    const double peak = std::max({shown.x, shown.y, shown.z});
    if (peak > 0.99) continue; // there, floats are too few
    glm::dvec3 back = shown;
    if (peak > 0.76) {
      const double before = 0.0576 / (1 - peak) + 0.52;
      const double kept = 1 / (0.15 * (before - peak) + 1);
      back = ((shown - peak * (1 - kept)) / kept) * (before / peak);
    }
    const double least = std::min({back.x, back.y, back.z});
    back += least < 0.04 ? 0.4 * std::sqrt(std::max(least, 0.0)) - least : 0.04;
    EXPECT_LT(largest(back - color), 2e-3 * std::max(1.0, largest(color)))
        << color.x << " " << color.y << " " << color.z;
  }
}

// The polynomial that three.js and Filament draw AgX's curve with (Wrensch, "Minimal AgX Implementation", 2023) is a
// fit of it. What the curve makes of a grey is encoded by 2.2.
TEST(ToneMapping, AgxIsNearTheKnownPolynomial) {
  double squares = 0;
  constexpr int kSteps = 1000;
  for (int i = 0; i <= kSteps; ++i) {
    const double x = static_cast<double>(i) / kSteps;
    const double known = ((((((15.5 * x - 40.14) * x + 31.96) * x - 6.868) * x + 0.4298) * x + 0.1191) * x) - 0.00232;
    const double grey = 0.18 * std::exp2(16.5 * x - 10);
    const double off = std::pow(mapped(ToneMapping::agx, glm::dvec3(grey)).g, 1 / 2.2) - known;
    EXPECT_LT(std::abs(off), 6e-3) << x;
    squares += off * off;
  }
  EXPECT_LT(squares / kSteps, 8e-6);
}

TEST(ToneMapping, AgxKeepsMiddleGreyInTheMiddleOfItsCurve) {
  EXPECT_NEAR(mapped(ToneMapping::agx, glm::dvec3(0.18)).g, std::pow(0.5, 2.2), 1e-5);
}

TEST(ToneMapping, BlackStaysBlackAndGreyBecomesBrighterGrey) {
  for (const ToneMapping tone : kTones) {
    EXPECT_LT(largest(mapped(tone, glm::dvec3(0))), 1e-6) << toneOf(tone, true);
    double last = 0;
    for (double stops = -12; stops < 20; stops += 0.01) {
      const glm::dvec3 grey = mapped(tone, glm::dvec3(std::exp2(stops)));
      EXPECT_GE(grey.g, last - 1e-6) << toneOf(tone, true) << " at " << stops;
      EXPECT_LE(std::max(std::abs(grey.r - grey.g), std::abs(grey.b - grey.g)), 2e-4) << toneOf(tone, true);
      EXPECT_LE(grey.g, 1.0);
      last = grey.g;
    }
    EXPECT_GT(last, 0.99) << toneOf(tone, true);
  }
}

TEST(ToneMapping, EachWordIsACurveOfItsOwnAndLinearNumbersHaveNone) {
  for (const ToneMapping tone : kTones) {
    EXPECT_EQ(toneOf(tone, false), GNOMON_TONE_NONE);
    for (const ToneMapping other : kTones) EXPECT_EQ(toneOf(tone, true) == toneOf(other, true), tone == other);
  }
}

} // namespace
} // namespace gnomon
