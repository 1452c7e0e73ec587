#include "renderer/scene/texture_alpha.h"

#include <algorithm>
#include <cmath>
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

/// The image and its levels: 2 x 1 texels of alpha 115 and 166, then one of 141.
AlphaLevels levels() {
  return AlphaLevels(image());
}

/// Of the middle of the left half, where a pixel is as wide as so many texels and next to nothing high.
double ofPixelsAsWideAs(double texels, MinFilter filter, bool nearest = false) {
  TextureUse of = use(Wrap::clampToEdge, Wrap::clampToEdge, nearest);
  of.minFilter = filter;
  return textureAlpha(levels(), of, {{0.25, 0.5}, {texels / 4, 0}, {0, 0.001}});
}

TEST(TextureAlpha, APictureReadsTheLevelWhoseTexelsAreAsLargeAsItsPixels) {
  const AlphaLevels all = levels();
  ASSERT_EQ(all.count(), 3u);
  EXPECT_EQ(all.of(1).at(0, 0), 115); // (0 + 51 + 204 + 204) / 4, a half rounded up
  EXPECT_EQ(all.of(1).at(1, 0), 166);
  EXPECT_EQ(all.of(2).at(0, 0), 141);
  const double full = (0.0 + 51 + 204 + 204) / 4 / 255, half = 115 / 255.0, last = 141 / 255.0;
  const MinFilter mixed = MinFilter::linearMipmapLinear, one = MinFilter::linearMipmapNearest;
  for (const double texels : {0.0, 0.5, 1.0}) EXPECT_NEAR(ofPixelsAsWideAs(texels, mixed), full, 1e-12) << texels;
  EXPECT_NEAR(ofPixelsAsWideAs(2, mixed), half, 1e-12);
  EXPECT_NEAR(ofPixelsAsWideAs(std::sqrt(8), mixed), (half + last) / 2, 1e-12);
  for (const double texels : {4.0, 100.0, 1e30}) EXPECT_NEAR(ofPixelsAsWideAs(texels, mixed), last, 1e-12) << texels;
  // The nearer one.
  EXPECT_NEAR(ofPixelsAsWideAs(1.41, one), full, 1e-12);
  EXPECT_NEAR(ofPixelsAsWideAs(1.42, one), half, 1e-12);
  EXPECT_NEAR(ofPixelsAsWideAs(2.82, one), half, 1e-12);
  EXPECT_NEAR(ofPixelsAsWideAs(2.84, one), last, 1e-12);
}

TEST(TextureAlpha, WithoutLevelsAPictureReadsTheLargestOne) {
  const double full = (0.0 + 51 + 204 + 204) / 4 / 255;
  EXPECT_NEAR(ofPixelsAsWideAs(4, MinFilter::linear), full, 1e-12);
  EXPECT_NEAR(ofPixelsAsWideAs(4, MinFilter::nearest), 204 / 255.0, 1e-12);
}

TEST(TextureAlpha, LargerAndSmallerThanItIsATextureHasFiltersOfTheirOwn) {
  const double full = (0.0 + 51 + 204 + 204) / 4 / 255;
  EXPECT_NEAR(ofPixelsAsWideAs(0.5, MinFilter::linear, true), 204 / 255.0, 1e-12);
  EXPECT_NEAR(ofPixelsAsWideAs(2, MinFilter::linear, true), full, 1e-12);
  EXPECT_NEAR(ofPixelsAsWideAs(2, MinFilter::nearestMipmapNearest, false), 115 / 255.0, 1e-12);
}

} // namespace
} // namespace gnomon
