#include "renderer/reference/alpha.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <limits>

namespace gnomon {
namespace {

/// 4 x 2 texels, alpha 0, 51, 102, 153 in the upper row, 204 in all of the lower one.
AlphaPlane image() {
  std::vector<std::uint8_t> pixels;
  for (const int alpha : {0, 51, 102, 153, 204, 204, 204, 204})
    pixels.insert(pixels.end(), {9, 9, 9, std::uint8_t(alpha)});
  return AlphaPlane({4, 2, {"R", "G", "B", "A"}, pixels});
}

TextureUse use(Wrap wrapS, Wrap wrapT, bool nearest) {
  return {0, 0, wrapS, wrapT, nearest};
}

TEST(TextureAlpha, IsTheTexelsAtTheirCentresAndBetweenThemInBetween) {
  const TextureUse linear = use(Wrap::clampToEdge, Wrap::clampToEdge, false);
  for (int x = 0; x < 4; ++x) EXPECT_NEAR(textureAlpha(image(), linear, {(x + 0.5) / 4, 0.25}), 0.2 * x, 1e-12);
  EXPECT_NEAR(textureAlpha(image(), linear, {0.375 + 0.0625, 0.25}), 0.25, 1e-12);
  EXPECT_NEAR(textureAlpha(image(), linear, {0.125, 0.5}), 0.4, 1e-12);
}

TEST(TextureAlpha, NearestTakesTheTexelThatHoldsThePlace) {
  const TextureUse nearest = use(Wrap::repeat, Wrap::repeat, true);
  EXPECT_NEAR(textureAlpha(image(), nearest, {0.49, 0.1}), 0.2, 1e-12);
  EXPECT_NEAR(textureAlpha(image(), nearest, {0.51, 0.49}), 0.4, 1e-12);
  EXPECT_NEAR(textureAlpha(image(), nearest, {0.51, 0.51}), 0.8, 1e-12);
}

TEST(TextureAlpha, WrapsAsTheSamplerSays) {
  const auto at = [&](Wrap wrap, double u) { return textureAlpha(image(), use(wrap, wrap, true), {u, 0.25}); };
  for (int x = -9; x < 13; ++x) {
    const double u = (x + 0.5) / 4;
    const int repeated = ((x % 4) + 4) % 4;
    const int period = ((x % 8) + 8) % 8;
    EXPECT_NEAR(at(Wrap::repeat, u), 0.2 * repeated, 1e-12) << x;
    EXPECT_NEAR(at(Wrap::mirroredRepeat, u), 0.2 * (period < 4 ? period : 7 - period), 1e-12) << x;
    EXPECT_NEAR(at(Wrap::clampToEdge, u), 0.2 * std::clamp(x, 0, 3), 1e-12) << x;
  }
  // Between the last texel and the first, or the last and itself.
  const auto seam = [&](Wrap wrap) { return textureAlpha(image(), use(wrap, wrap, false), {1.0, 0.25}); };
  EXPECT_NEAR(seam(Wrap::repeat), 0.3, 1e-12);
  EXPECT_NEAR(seam(Wrap::mirroredRepeat), 0.6, 1e-12);
  EXPECT_NEAR(seam(Wrap::clampToEdge), 0.6, 1e-12);
}

TEST(TextureAlpha, CoordinatesOfAnySizeStayInTheImage) {
  for (const Wrap wrap : {Wrap::repeat, Wrap::mirroredRepeat, Wrap::clampToEdge}) {
    for (const double u : {1e30, -1e30, double(std::numeric_limits<float>::quiet_NaN())}) {
      for (const bool nearest : {true, false}) {
        const double alpha = textureAlpha(image(), use(wrap, wrap, nearest), {u, u});
        EXPECT_FALSE(alpha < 0 || alpha > 1) << u;
      }
    }
  }
}

} // namespace
} // namespace gnomon
