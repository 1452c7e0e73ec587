#include "renderer/scene/mask_coverage.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <random>

#include "renderer/scene/texture_reads.h"

namespace gnomon {
namespace {

/// A picture whose alpha is alphaAt(column, row), 0..255.
template <class AlphaAt>
AlphaLevels levelsOf(int width, int height, AlphaAt alphaAt) {
  std::vector<std::uint8_t> pixels;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) pixels.insert(pixels.end(), {0, 0, 0, static_cast<std::uint8_t>(alphaAt(x, y))});
  }
  return AlphaLevels(AlphaPlane({width, height, {"R", "G", "B", "A"}, pixels}));
}

/// Leaves of a few texels each, at random, over about a third of it.
AlphaLevels leaves() {
  std::mt19937 random(7);
  std::vector<glm::vec3> discs;
  for (int i = 0; i < 700; ++i) {
    discs.emplace_back(random() % 256, random() % 256, 1 + static_cast<double>(random() % 1000) / 400);
  }
  return levelsOf(256, 256, [&](int x, int y) {
    float alpha = 0;
    for (const glm::vec3& disc : discs) {
      const glm::vec2 way = glm::abs(glm::vec2(x, y) - glm::vec2(disc));
      const glm::vec2 round = glm::min(way, glm::vec2(256) - way);
      alpha = std::max(alpha, std::clamp(disc.z + 0.5f - glm::length(round), 0.0f, 1.0f));
    }
    return 255 * alpha;
  });
}

/// The share of a wide picture that shows the surface where each pixel is as large as so many texels.
double shownShare(const MaskCoverage& coverage, const AlphaLevels& levels, const TextureUse& use, double texels,
                  double factor, double cutoff) {
  const glm::dvec2 step = texels / glm::dvec2(coverage.size());
  int shown = 0;
  constexpr int kPixels = 257;
  for (int y = 0; y < kPixels; ++y) {
    for (int x = 0; x < kPixels; ++x) {
      const TexturePlace place{glm::dvec2(x + 0.31, y + 0.47) * step, {step.x, 0}, {0, step.y}};
      const double alpha = textureAlpha(levels, use, place);
      shown += coverage.keeps({place.uv, halvingsAt(place, coverage.size()), alpha}, factor, cutoff);
    }
  }
  return static_cast<double>(shown) / (kPixels * kPixels);
}

double shownShare(const AlphaLevels& levels, const TextureUse& use, double texels, double factor, double cutoff) {
  return shownShare(MaskCoverage(levels, use), levels, use, texels, factor, cutoff);
}

TEST(MaskCoverage, AsMuchShowsFromAfarAsNearWhateverFactorAndCutoff) {
  const AlphaLevels levels = leaves();
  for (const MinFilter filter : {MinFilter::linearMipmapLinear, MinFilter::linearMipmapNearest,
                                 MinFilter::nearestMipmapLinear, MinFilter::nearestMipmapNearest}) {
    const TextureUse use{.image = 0, .minFilter = filter};
    const MaskCoverage coverage(levels, use);
    // Of levels of a few texels, each of one alpha, a row of the table does not lie between two others.
    const double slack = filter == MinFilter::nearestMipmapLinear ? 0.07 : 0.03;
    for (const auto& [factor, cutoff] : {std::pair(1.0, 0.1), std::pair(1.0, 0.5), std::pair(1.0, 0.9),
                                         std::pair(0.6, 0.1), std::pair(0.6, 0.5), std::pair(0.6, 0.59)}) {
      const double near = shownShare(coverage, levels, use, 0.9961, factor, cutoff);
      for (const double texels : {1.5, 3.1, 7.3, 21.7, 90.3, 311.0, 5003.0}) {
        EXPECT_NEAR(shownShare(coverage, levels, use, texels, factor, cutoff), near, slack)
            << texels << " texels, cutoff " << cutoff << ", factor " << factor;
      }
    }
  }
}

/// What a cutoff does to the means of such a pattern is to show all of it, or nothing.
TEST(MaskCoverage, DotsAndHolesTooSmallToBeSeenShowTheirShare) {
  const auto dots = levelsOf(64, 64, [](int x, int y) { return x % 4 < 2 && y % 4 < 2 ? 255 : 0; });
  const auto holes = levelsOf(64, 64, [](int x, int y) { return x % 4 < 2 && y % 4 < 2 ? 0 : 255; });
  TextureUse use{.image = 0};
  use.nearest = true;
  for (const double texels : {8.0, 30.0, 64.0, 1000.0}) {
    EXPECT_NEAR(shownShare(dots, use, texels, 1, 0.5), 0.25, 0.03) << texels;
    EXPECT_NEAR(shownShare(holes, use, texels, 1, 0.5), 0.75, 0.03) << texels;
  }
}

TEST(MaskCoverage, WhatHasNoHolesOrNothingElseStaysAsItIs) {
  const TextureUse use{.image = 0};
  const auto full = levelsOf(16, 16, [](int, int) { return 255; });
  const auto empty = levelsOf(16, 16, [](int, int) { return 0; });
  for (const double texels : {0.5, 3.0, 100.0}) {
    EXPECT_EQ(shownShare(full, use, texels, 1, 1), 1);
    EXPECT_EQ(shownShare(full, use, texels, 0.5, 0.6), 0) << "the factor alone decides";
    EXPECT_EQ(shownShare(full, use, texels, 0, 0), 1) << "nothing is below a cutoff of 0";
    EXPECT_EQ(shownShare(empty, use, texels, 1, 0.01), 0);
  }
  // The same alpha everywhere, at the cutoff and on both sides of it.
  const auto even = levelsOf(16, 16, [](int, int) { return 51; });
  for (const double texels : {0.5, 3.0, 100.0}) {
    EXPECT_EQ(shownShare(even, use, texels, 1, 0.19), 1) << texels;
    EXPECT_EQ(shownShare(even, use, texels, 1, 0.2), 1) << texels;
    EXPECT_EQ(shownShare(even, use, texels, 1, 0.21), 0) << texels;
  }
}

TEST(MaskCoverage, LevelsAreCountedWhereTheyAreRead) {
  const auto many = levelsOf(16, 4, [](int x, int) { return x; });
  const auto one = levelsOf(1, 1, [](int, int) { return 9; });
  EXPECT_TRUE(MaskCoverage::countsLevels(many, {.image = 0}));
  EXPECT_FALSE(MaskCoverage::countsLevels(many, {.image = 0, .minFilter = MinFilter::linear}));
  EXPECT_FALSE(MaskCoverage::countsLevels(one, {.image = 0}));
  EXPECT_EQ(MaskCoverage(many, {.image = 0}).rows(), 9) << "two for each of five levels but the last";
}

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
