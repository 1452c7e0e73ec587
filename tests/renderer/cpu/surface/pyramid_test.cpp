#include "renderer/cpu/surface/pyramid.h"

#include <algorithm>
#include <array>
#include <gtest/gtest.h>
#include <span>
#include <utility>

#include "renderer/scene/scene_image.h"
#include "tests/renderer/cpu/surface/sampled_truth.h"

namespace gnomon::cpu {
namespace {

void expectSameLevels(const Pyramid& a, const Pyramid& b, std::size_t first) {
  ASSERT_EQ(a.levels.size(), b.levels.size());
  for (std::size_t i = first; i < a.levels.size(); ++i) {
    ASSERT_EQ(a.levels[i].width, b.levels[i].width);
    ASSERT_EQ(a.levels[i].height, b.levels[i].height);
    const auto texels = std::span(
        a.levels[i].texels, static_cast<std::size_t>(a.levels[i].width) * static_cast<std::size_t>(a.levels[i].height));
    ASSERT_TRUE(std::equal(texels.begin(), texels.end(), b.levels[i].texels)) << i;
  }
}

TEST(Pyramid, HalvesDownToOneTexelAndKeepsTheImage) {
  const auto image = noise(20, 6);
  const Pyramid pyramid = pyramidOf(*image, false);
  std::vector<glm::ivec2> sizes;
  for (const TextureLevel& level : pyramid.levels) sizes.emplace_back(level.width, level.height);
  EXPECT_EQ(sizes, (std::vector<glm::ivec2>{{20, 6}, {10, 3}, {5, 1}, {2, 1}, {1, 1}}));
  const void* pixels = std::get<std::vector<std::uint8_t>>(image->pixels).data();
  EXPECT_EQ(static_cast<const void*>(pyramid.levels[0].texels), pixels);
}

TEST(Pyramid, ATexelIsTheMeanOfFourInLinearLight) {
  const auto image = noise(64, 32);
  for (const bool srgb : {false, true}) {
    const Pyramid pyramid = pyramidOf(*image, srgb);
    const TextureLevel& full = pyramid.levels[0];
    const TextureLevel& half = pyramid.levels[1];
    for (int y = 0; y < half.height; ++y) {
      for (int x = 0; x < half.width; ++x) {
        glm::dvec4 mean(0);
        for (int i = 0; i < 4; ++i) {
          mean += 0.25 * texelOf(full.texels[(2 * y + i / 2) * full.width + 2 * x + i % 2], srgb);
        }
        const std::uint32_t texel = half.texels[y * half.width + x];
        // Half a byte's step to each side.
        for (int c = 0; c < 4; ++c) {
          const double byte = texel >> (8 * c) & 255u;
          const auto number = [&](double b) { return srgb && c < 3 ? linearFromSrgb(b / 255.0) : b / 255.0; };
          ASSERT_GE(mean[c], number(byte - 0.501)) << x << " " << y << " " << c;
          ASSERT_LE(mean[c], number(byte + 0.501)) << x << " " << y << " " << c;
        }
      }
    }
  }
}

TEST(HalvedRows, AreThoseOfTheWholeImageHoweverManyComeAtOnce) {
  EXPECT_EQ(evenLevels({48, 64}), 4u);
  EXPECT_EQ(evenLevels({96, 65}), 0u);
  for (const ImageSize& size : {ImageSize{48, 144}, ImageSize{256, 64}, ImageSize{30, 50}, ImageSize{7, 5}}) {
    const auto image = noise(size.width, size.height);
    const auto& bytes = std::get<std::vector<std::uint8_t>>(image->pixels);
    const std::size_t row = 4 * static_cast<std::size_t>(size.width);
    for (const bool srgb : {false, true}) {
      const Pyramid whole = pyramidOf(*image, srgb);
      for (std::size_t level = 0; level <= evenLevels(size); ++level) {
        for (const bool atOnce : {false, true}) {
          HalvedRows halved(size, srgb, level);
          const int step = atOnce ? size.height : halved.atOnce();
          for (int y = 0; y < size.height; y += step) {
            const auto rows = static_cast<std::size_t>(std::min(step, size.height - y));
            halved.add(y, std::span(bytes).subspan(static_cast<std::size_t>(y) * row, rows * row));
          }
          const Pyramid streamed = pyramidOf(size, srgb, std::move(halved).given(), level);
          EXPECT_EQ(streamed.levels[level].texels, streamed.owned[level]->data());
          expectSameLevels(streamed, whole, level);
        }
      }
    }
  }
}

TEST(Pyramid, WhereASizeIsOddATexelIsMixedFromTheTwoAroundIt) {
  const auto image = noise(5, 1);
  const Pyramid pyramid = pyramidOf(*image, false);
  const std::uint32_t* full = pyramid.levels[0].texels;
  const glm::dvec4 first = 0.25 * texelOf(full[0], false) + 0.75 * texelOf(full[1], false);
  const glm::dvec4 second = 0.75 * texelOf(full[3], false) + 0.25 * texelOf(full[4], false);
  EXPECT_LT(glm::length(texelOf(pyramid.levels[1].texels[0], false) - first), 1.01 / 255);
  EXPECT_LT(glm::length(texelOf(pyramid.levels[1].texels[1], false) - second), 1.01 / 255);
}

TEST(Pyramid, ItsAlphaIsWhatRaysReadOfTheSameLevels) {
  for (const auto& [width, height] : {std::pair(64, 32), std::pair(20, 6), std::pair(13, 1), std::pair(7, 31)}) {
    const auto image = noise(width, height);
    const Pyramid pyramid = pyramidOf(*image, true);
    const AlphaLevels alpha{AlphaPlane(*image)};
    ASSERT_EQ(alpha.count(), pyramid.levels.size());
    for (std::size_t i = 0; i < alpha.count(); ++i) {
      const TextureLevel& level = pyramid.levels[i];
      ASSERT_EQ(glm::ivec2(alpha.of(i).width(), alpha.of(i).height()), glm::ivec2(level.width, level.height));
      for (int texel = 0; texel < level.width * level.height; ++texel) {
        const int byte = alpha.of(i).at(static_cast<std::size_t>(texel % level.width),
                                        static_cast<std::size_t>(texel / level.width));
        // Of levels with odd sides each is rounded for itself.
        EXPECT_NEAR(byte, static_cast<int>(level.texels[texel] >> 24), width == 64 ? 0 : 2) << width << ", " << i;
      }
    }
  }
}

TEST(Pyramid, FromAnyLevelOnItIsTheSameHoweverMuchOfItIsKnown) {
  const auto image = noise(100, 37);
  for (const bool srgb : {false, true}) {
    const Pyramid full = pyramidOf(*image, srgb);
    for (std::size_t finest = 1; finest < full.levels.size(); ++finest) {
      const Pyramid small = pyramidOf(*image, srgb, finest);
      EXPECT_EQ(small.finest, finest);
      for (std::size_t i = 0; i < finest; ++i) {
        EXPECT_EQ(small.levels[i].texels, nullptr) << i;
        EXPECT_EQ(small.levels[i].width, full.levels[i].width) << i;
      }
      expectSameLevels(small, full, finest);
      for (std::size_t larger = 0; larger < finest; ++larger) {
        const Pyramid more = pyramidOf(*image, srgb, larger, small);
        expectSameLevels(more, full, larger);
        EXPECT_EQ(more.levels.back().texels, small.levels.back().texels) << "what is known is not made again";
      }
    }
  }
}

TEST(Pyramid, HasAsManySizesAsTheLongerSideHasHalves) {
  for (const auto& [width, height, levels] :
       {std::array{1, 1, 1}, std::array{2, 1, 2}, std::array{3, 8, 4}, std::array{8192, 5, 14}}) {
    EXPECT_EQ(levelsOf(width, height), static_cast<std::size_t>(levels));
  }
}

} // namespace
} // namespace gnomon::cpu
