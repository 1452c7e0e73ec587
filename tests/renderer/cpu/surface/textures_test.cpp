#include "renderer/cpu/surface/textures.h"

#include <cmath>
#include <gtest/gtest.h>
#include <thread>

#include "tests/renderer/cpu/instruction_sets.h"
#include "tests/renderer/cpu/surface/sampled_truth.h"
#include "tests/renderer/cpu/surface/sampling_kernels.h"

namespace gnomon::cpu {
namespace {

TEST(CpuTextures, HalvesDownToOneTexelAndKeepsTheImage) {
  const auto image = noise(20, 6);
  const Pyramid pyramid = pyramidOf(*image, false);
  std::vector<glm::ivec2> sizes;
  for (const TextureLevel& level : pyramid.levels) sizes.emplace_back(level.width, level.height);
  EXPECT_EQ(sizes, (std::vector<glm::ivec2>{{20, 6}, {10, 3}, {5, 1}, {2, 1}, {1, 1}}));
  const void* pixels = std::get<std::vector<std::uint8_t>>(image->pixels).data();
  EXPECT_EQ(static_cast<const void*>(pyramid.levels[0].texels), pixels);
}

TEST(CpuTextures, ATexelIsTheMeanOfFourInLinearLight) {
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

TEST(CpuTextures, AreTheSameByManyCores) {
  for (const glm::ivec2& size : {glm::ivec2(512, 256), glm::ivec2(300, 500)}) {
    const auto image = noise(size.x, size.y);
    for (const bool srgb : {false, true}) {
      EXPECT_EQ(pyramidOf(*image, srgb, Cores::all).owned, pyramidOf(*image, srgb, Cores::one).owned);
    }
  }
}

TEST(CpuTextures, WhereASizeIsOddATexelIsMixedFromTheTwoAroundIt) {
  const auto image = noise(5, 1);
  const Pyramid pyramid = pyramidOf(*image, false);
  const std::uint32_t* full = pyramid.levels[0].texels;
  const glm::dvec4 first = 0.25 * texelOf(full[0], false) + 0.75 * texelOf(full[1], false);
  const glm::dvec4 second = 0.75 * texelOf(full[3], false) + 0.25 * texelOf(full[4], false);
  EXPECT_LT(glm::length(texelOf(pyramid.levels[1].texels[0], false) - first), 1.01 / 255);
  EXPECT_LT(glm::length(texelOf(pyramid.levels[1].texels[1], false) - second), 1.01 / 255);
}

SceneImages noises(std::initializer_list<int> sides) {
  SceneImages images;
  for (const int side : sides) images.push_back(std::make_shared<const SceneImage>(*noise(side, side)));
  return images;
}

TEST(CpuTextures, AreMadeOnceWhoeverAsks) {
  const Textures textures(noises({256, 8}));
  EXPECT_EQ(textures.bytes(), 0u);
  std::vector<const Pyramid*> found(4);
  std::vector<std::thread> threads;
  for (const Pyramid*& pyramid : found) threads.emplace_back([&] { pyramid = &textures.of(0, true); });
  for (std::thread& thread : threads) thread.join();
  for (const Pyramid* pyramid : found) EXPECT_EQ(pyramid, found[0]);
  EXPECT_EQ(textures.bytes(), (256u * 256u - 1u) / 3u * 4u);
  EXPECT_NE(&textures.of(0, false), found[0]);
}

TEST(CpuTextures, AreMadeAheadWhereTheyAreNeededAndTellOfBrokenImages) {
  SceneImages images = noises({16, 8});
  const CheckedImage broken{PictureFormat::png, {4, 4}, Bytes(60, 0)};
  images.push_back(std::make_shared<const SceneImage>(broken, "/images/7"));
  const Textures textures(images);
  const std::vector<TextureImage> sound{{0, false}, {0, true}, {1, true}};
  ASSERT_TRUE(textures.need(sound));
  const std::size_t bytes = textures.bytes();
  EXPECT_EQ(bytes, 4u * (2 * (16u * 16u - 1u) / 3u + (8u * 8u - 1u) / 3u));
  (void)textures.of(1, true);
  ASSERT_TRUE(textures.need(sound));
  EXPECT_EQ(textures.bytes(), bytes) << "nothing is made twice";
  const Status missed = textures.need(std::vector<TextureImage>{{1, true}, {2, false}});
  ASSERT_FALSE(missed);
  EXPECT_EQ(missed.problems().front().code, ProblemCode::invalidScene);
  EXPECT_EQ(missed.problems().front().pointer, "/images/7");
}

TEST(CpuTextures, ImagesThatAreDecodedAheadAreThoseThatAreMade) {
  const std::vector<TextureImage> wanted{{0, false}, {0, true}, {1, true}};
  const auto texels = [&wanted](bool ahead) {
    const Textures textures(noises({64, 32}));
    std::future<void> decoding;
    if (ahead) decoding = textures.decodeAhead(wanted);
    EXPECT_EQ(decoding.valid(), ahead);
    EXPECT_TRUE(textures.need(wanted));
    EXPECT_FALSE(textures.decodeAhead(wanted).valid()) << "nothing is missing any more";
    std::vector<std::uint32_t> all;
    for (const TextureImage& each : wanted) {
      const TextureLevel& level = textures.of(each.image, each.srgb).levels[1];
      all.insert(all.end(), level.texels, level.texels + level.width * level.height);
    }
    return all;
  };
  EXPECT_EQ(texels(true), texels(false));

  const CheckedImage broken{PictureFormat::png, {4, 4}, Bytes(60, 0)};
  const Textures textures({std::make_shared<const SceneImage>(broken, "/images/7")});
  const std::vector<TextureImage> only{{0, true}};
  const std::future<void> decoding = textures.decodeAhead(only);
  const Status missed = textures.need(only);
  ASSERT_FALSE(missed);
  EXPECT_EQ(missed.problems().front().pointer, "/images/7");
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

void expectSampled(const Pyramid& texture, const TextureUse& use, const NumberTable& in) {
  const NumberTable out = sampledByLanes(texture, use, in);
  std::size_t off = 0;
  for (std::size_t row = 0; row < in.rows; ++row) {
    const auto pair = [&](std::size_t column) { return glm::dvec2(in.at(row, column), in.at(row, column + 1)); };
    const glm::dvec4 expected = sampledTruth(texture, use, pair(0), pair(2), pair(4));
    const glm::dvec4 found(out.triple(row, 0), out.at(row, 3));
    off += glm::length(found - expected) < 1e-3 ? 0 : 1;
    EXPECT_EQ(out.at(row, 4), out.at(row, 3)) << "alpha alone";
  }
  // At the border between two texels or levels rounding decides.
  EXPECT_LE(off, in.rows / 2000);
}

TEST(CpuTextures, AreReadAsOpenGlReadsThem) {
  const auto wide = noise(64, 16);
  const auto odd = noise(37, 53);
  const Pyramid textures[] = {pyramidOf(*wide, true), pyramidOf(*odd, false)};
  onEachInstructionSet([&] {
    for (const Pyramid& texture : textures) {
      const NumberTable in = places(texture.levels[0].width);
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
  const auto image = noise(16, 16);
  const Pyramid texture = pyramidOf(*image, true);
  NumberTable in = randomNumbers(160, kSamplingInputs, -1e30f, 1e30f);
  for (std::size_t i = 0; i < in.numbers.size(); i += 7) in.numbers[i] = std::nanf("");
  for (std::size_t i = 0; i < in.numbers.size(); i += 11) in.numbers[i] = INFINITY;
  onEachInstructionSet([&] {
    for (const float number : sampledByLanes(texture, {}, in).numbers) ASSERT_TRUE(std::isfinite(number));
  });
}

} // namespace
} // namespace gnomon::cpu
