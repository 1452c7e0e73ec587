#include "renderer/cpu/surface/textures.h"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <thread>

#include "renderer/image/picture_encode.h"
#include "tests/renderer/cpu/instruction_sets.h"
#include "tests/renderer/cpu/surface/sampled_truth.h"
#include "tests/renderer/cpu/surface/sampling_kernels.h"

namespace gnomon::cpu {
namespace {

SceneImages noises(std::initializer_list<int> sides) {
  SceneImages images;
  for (const int side : sides) images.push_back(std::make_shared<const SceneImage>(*noise(side, side)));
  return images;
}

/// Whose header and structure hold, and whose pixels don't.
CheckedImage brokenImage() {
  Bytes png = *encodePng({4, 4, {"R", "G", "B"}, std::vector<std::uint8_t>(48, 128)}, 1);
  png[png.size() - 20] ^= 0xff; // of the pixels, or their checksum
  return *checkImage(png, 16, 256);
}

TEST(CpuTextures, AreMadeOnceWhoeverAsks) {
  const Textures textures(noises({256, 8}));
  EXPECT_EQ(textures.bytes(), 0u);
  std::vector<const Pyramid*> found(4);
  std::vector<std::thread> threads;
  for (const Pyramid*& pyramid : found) threads.emplace_back([&] { pyramid = &textures.of(0, true).from(0); });
  for (std::thread& thread : threads) thread.join();
  for (const Pyramid* pyramid : found) EXPECT_EQ(pyramid, found[0]);
  EXPECT_EQ(textures.bytes(), (256u * 256u - 1u) / 3u * 4u);
  EXPECT_NE(&textures.of(0, false).from(0), found[0]);
}

TEST(CpuTextures, KeepTheSizesThatWereReadAndMakeLargerOnesWhenTheyAre) {
  const Textures textures(noises({256}));
  const Texture& texture = textures.of(0, true);
  EXPECT_FALSE(texture.isMade());
  const Pyramid& small = texture.from(3);
  EXPECT_EQ(textures.bytes(), (32u * 32u * 4u - 1u) / 3u * 4u);
  EXPECT_FALSE(texture.has(2));
  EXPECT_EQ(&texture.from(5), &small);
  const Pyramid& large = texture.from(1);
  EXPECT_TRUE(texture.has(1));
  EXPECT_EQ(textures.bytes(), (256u * 256u - 1u) / 3u * 4u);
  EXPECT_EQ(small.levels[3].texels, large.levels[3].texels) << "who reads the earlier ones may go on";
  EXPECT_EQ(&texture.from(3), &large);
}

TEST(CpuTextures, AreMadeWhereTheyAreNeededOfBrokenImagesToo) {
  SceneImages images = noises({16, 8});
  images.push_back(std::make_shared<const SceneImage>(brokenImage(), "/images/7"));
  const Textures textures(images);
  const std::vector<ReadTexture> sound{{{0, false}}, {{0, true}}, {{1, true}}};
  ASSERT_TRUE(textures.need(sound));
  const std::size_t bytes = textures.bytes();
  EXPECT_EQ(bytes, 4u * (2 * (16u * 16u - 1u) / 3u + (8u * 8u - 1u) / 3u));
  EXPECT_TRUE(textures.areMade(std::vector<TextureImage>{{1, true}, {0, false}}));
  EXPECT_FALSE(textures.areMade(std::vector<TextureImage>{{1, true}, {1, false}}));
  ASSERT_TRUE(textures.need(sound));
  EXPECT_EQ(textures.bytes(), bytes) << "nothing is made twice";
  EXPECT_THAT(damageOf(images), ::testing::IsEmpty());
  for (const std::size_t finest : {1u, 0u}) {
    const std::vector<ReadTexture> withBroken{{{1, true}}, {{2, false}, finest}};
    ASSERT_TRUE(textures.need(withBroken));
    EXPECT_TRUE(textures.of(2, false).has(finest));
    EXPECT_THAT(damageOf(images), ::testing::ElementsAre(::testing::HasSubstr("/images/7")));
  }
}

TEST(CpuTextures, ThoseMadeAheadAreThoseThatAreNeeded) {
  const std::vector<ReadTexture> wanted{{{0, false}}, {{0, true}, 2}, {{1, true}, 1}};
  const auto texels = [&wanted](bool ahead) {
    const Textures textures(noises({64, 32}));
    std::future<void> making;
    if (ahead) making = textures.makeAhead(wanted);
    EXPECT_EQ(making.valid(), ahead);
    EXPECT_TRUE(textures.need(wanted));
    EXPECT_FALSE(textures.makeAhead(wanted).valid()) << "nothing is missing any more";
    std::vector<std::uint32_t> all;
    for (const ReadTexture& each : wanted) {
      const TextureLevel& level = textures.of(each.texture).from(each.finest).levels[2];
      all.insert(all.end(), level.texels, level.texels + level.width * level.height);
    }
    return all;
  };
  EXPECT_EQ(texels(true), texels(false));

  const SceneImages images{std::make_shared<const SceneImage>(brokenImage(), "/images/7")};
  const Textures textures(images);
  const std::vector<ReadTexture> only{{{0, true}}};
  const std::future<void> making = textures.makeAhead(only);
  ASSERT_TRUE(textures.need(only));
  EXPECT_THAT(damageOf(images), ::testing::ElementsAre(::testing::HasSubstr("/images/7")));
}

/// Coordinates from -3 to 3, and steps from a 30th of a texel to more than the whole texture.
NumberTable places(int width) {
  NumberTable in = randomNumbers(16'000, kSamplingInputs, -1.0f, 1.0f);
  for (std::size_t row = 0; row < in.rows; ++row) {
    const float size = std::exp2(static_cast<float>(row / 16 % 14) - 5.0f) / static_cast<float>(width);
    for (std::size_t column = 0; column < kSamplingInputs; ++column) {
      in.column(column)[row] *= column < 2 ? 3.0f : size;
    }
  }
  return in;
}

void expectSampled(const Texture& texture, const TextureUse& use, const NumberTable& in) {
  const NumberTable out = sampledByLanes(texture, use, in);
  std::size_t off = 0;
  for (std::size_t row = 0; row < in.rows; ++row) {
    const auto pair = [&](std::size_t column) { return glm::dvec2(in.at(row, column), in.at(row, column + 1)); };
    const glm::dvec4 expected = sampledTruth(texture.from(0), use, pair(0), pair(2), pair(4));
    const glm::dvec4 found(out.triple(row, 0), out.at(row, 3));
    off += glm::length(found - expected) < 1e-3 ? 0 : 1;
    EXPECT_EQ(out.at(row, 4), out.at(row, 3)) << "alpha alone";
  }
  // At the border between two texels or levels rounding decides.
  EXPECT_LE(off, in.rows / 2000);
}

TEST(CpuTextures, AreReadAsOpenGlReadsThem) {
  const Texture wide(std::make_shared<const SceneImage>(*noise(64, 16)), true);
  const Texture odd(std::make_shared<const SceneImage>(*noise(37, 53)), false);
  onEachInstructionSet([&] {
    for (const Texture* const each : {&wide, &odd}) {
      const Texture& texture = *each;
      const NumberTable in = places(texture.width());
      for (const Wrap wrap : {Wrap::repeat, Wrap::clampToEdge, Wrap::mirroredRepeat}) {
        for (const MinFilter filter :
             {MinFilter::linearMipmapLinear, MinFilter::linearMipmapNearest, MinFilter::nearestMipmapLinear,
              MinFilter::nearestMipmapNearest, MinFilter::linear, MinFilter::nearest}) {
          SCOPED_TRACE(testing::Message() << static_cast<int>(wrap) << " " << static_cast<int>(filter));
          TextureUse use;
          use.wrapS = wrap;
          use.wrapT = wrap == Wrap::repeat ? Wrap::mirroredRepeat : wrap;
          use.minFilter = filter;
          use.nearest = filter == MinFilter::nearest || filter == MinFilter::linear;
          expectSampled(texture, use, in);
        }
      }
    }
  });
}

TEST(CpuTextures, PlacesThatAreNoNumbersGiveSomeTexel) {
  const Texture texture(std::make_shared<const SceneImage>(*noise(16, 16)), true);
  NumberTable in = randomNumbers(160, kSamplingInputs, -1e30f, 1e30f);
  for (std::size_t i = 0; i < in.numbers.size(); i += 7) in.numbers[i] = std::nanf("");
  for (std::size_t i = 0; i < in.numbers.size(); i += 11) in.numbers[i] = INFINITY;
  onEachInstructionSet([&] {
    for (const float number : sampledByLanes(texture, {}, in).numbers) ASSERT_TRUE(std::isfinite(number));
  });
}

} // namespace
} // namespace gnomon::cpu
