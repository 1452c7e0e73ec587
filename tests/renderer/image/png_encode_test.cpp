#include <gtest/gtest.h>
#include <random>
#include <rapidcheck.h>
#include <thread>
#include <zlib.h>

#include "renderer/image/image_codec.h"
#include "renderer/image/image_container.h"
#include "renderer/image/picture_encode.h"

namespace gnomon {
namespace {

using Pixels = std::vector<std::uint8_t>;

const std::vector<std::string>& channelsOf(int count) {
  static const std::vector<std::string> grey{"Y"}, rgb{"R", "G", "B"}, rgba{"R", "G", "B", "A"};
  return count == 1 ? grey : count == 3 ? rgb : rgba;
}

/// Slopes, flat parts, repeated rows and noise.
Image picture(int width, int height, int channels, unsigned seed) {
  std::mt19937 random(seed);
  Pixels pixels;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (int channel = 0; channel < channels; ++channel) {
        const int kind = (x / 50 + y / 11 + static_cast<int>(seed)) % 4;
        const int value = kind == 0   ? 200
                          : kind == 1 ? x + y + 40 * channel
                          : kind == 2 ? x * x
                                      : static_cast<int>(random());
        pixels.push_back(static_cast<std::uint8_t>(value));
      }
    }
  }
  return {width, height, channelsOf(channels), std::move(pixels)};
}

const Pixels& pixelsOf(const Image& image) {
  return std::get<Pixels>(image.pixels);
}

/// The same samples as the decoder gives them: RGBA.
Pixels asRgba(const Image& image) {
  const Pixels& pixels = pixelsOf(image);
  const std::size_t channels = image.channels.size();
  Pixels rgba;
  for (std::size_t i = 0; i < pixels.size(); i += channels) {
    for (std::size_t c = 0; c < 3; ++c) rgba.push_back(pixels[i + (channels == 1 ? 0 : c)]);
    rgba.push_back(channels == 4 ? pixels[i + 3] : 255);
  }
  return rgba;
}

/// The decoder's pixels; empty where it refuses the file.
Pixels decoded(const Bytes& png) {
  auto image = decodeImage(png, 20000, 1 << 24);
  return image ? pixelsOf(*image) : Pixels{};
}

void expectComesBack(const Image& image, int level) {
  const std::string what = std::to_string(image.width) + "x" + std::to_string(image.height) + " of " +
                           std::to_string(image.channels.size()) + " at level " + std::to_string(level);
  const auto png = encodePng(image, level);
  ASSERT_TRUE(png) << what;
  const auto size = imageSize(*png);
  ASSERT_TRUE(size) << what;
  EXPECT_EQ(size->width, image.width);
  EXPECT_EQ(size->height, image.height);
  EXPECT_TRUE(decoded(*png) == asRgba(image)) << what;
}

struct Chunk {
  std::string type;
  Bytes data;
};

/// Every chunk; each checksum is expected to be right.
std::vector<Chunk> chunksOf(const Bytes& png) {
  std::vector<Chunk> chunks;
  for (std::size_t at = 8; at + 12 <= png.size();) {
    const std::size_t length = bigEndian(png, at, 4);
    const auto body = png.begin() + static_cast<std::ptrdiff_t>(at + 8);
    chunks.push_back({std::string(body - 4, body), Bytes(body, body + static_cast<std::ptrdiff_t>(length))});
    EXPECT_EQ(bigEndian(png, at + 8 + length, 4), crc32(0, png.data() + at + 4, static_cast<uInt>(length + 4)));
    at += 12 + length;
  }
  return chunks;
}

TEST(EncodePng, ComesBackAsItWas) {
  EXPECT_TRUE(rc::check("decode(encode(image)) == image", [] {
    const int width = *rc::gen::inRange(1, 40);
    const int height = *rc::gen::inRange(1, 70);
    const int channels = *rc::gen::element(1, 3, 4);
    const std::size_t count = static_cast<std::size_t>(width * height * channels);
    const auto pixels = *rc::gen::container<Pixels>(count, rc::gen::arbitrary<std::uint8_t>());
    const Image image{width, height, channelsOf(channels), pixels};
    const auto png = encodePng(image, *rc::gen::inRange(0, 10));
    RC_ASSERT(bool(png));
    RC_ASSERT(decoded(*png) == asRgba(image));
  }));
}

TEST(EncodePng, EveryLevelKeepsEveryShape) {
  for (int level = 0; level <= 9; ++level) {
    for (const int channels : {1, 3, 4}) {
      expectComesBack(picture(1, 1, channels, 1), level);
      expectComesBack(picture(1, 131, channels, 2), level);
      expectComesBack(picture(333, 129, channels, 3), level);
    }
  }
}

TEST(EncodePng, WritesTheWidestFrame) {
  for (const int level : {0, 1, 2, 4}) expectComesBack(picture(16384, 18, 4, 4), level);
}

TEST(EncodePng, WritesGreyAndRgb) {
  const auto grey = encodePng({2, 1, {"Y"}, Pixels{3, 250}}, 2);
  ASSERT_TRUE(grey);
  EXPECT_EQ((*grey)[25], 0) << "colour type";
  EXPECT_EQ(decoded(*grey), (Pixels{3, 3, 3, 255, 250, 250, 250, 255}));
  const auto rgb = encodePng({1, 1, {"R", "G", "B"}, Pixels{3, 4, 5}}, 2);
  ASSERT_TRUE(rgb);
  EXPECT_EQ((*rgb)[25], 2) << "colour type";
  EXPECT_EQ(decoded(*rgb), (Pixels{3, 4, 5, 255}));
}

TEST(EncodePng, HasSoundChunksAndOneSoundStream) {
  const Image image = picture(97, 83, 3, 5);
  for (int level = 0; level <= 9; ++level) {
    Bytes stream;
    std::string order;
    for (const Chunk& chunk : chunksOf(*encodePng(image, level))) {
      if (!order.ends_with(chunk.type)) order += chunk.type;
      if (chunk.type == "IDAT") stream.insert(stream.end(), chunk.data.begin(), chunk.data.end());
    }
    EXPECT_EQ(order, "IHDRgAMAsRGBcHRMIDATIEND");
    Bytes filtered(1 << 16);
    uLongf size = filtered.size();
    uLong used = stream.size();
    EXPECT_EQ(uncompress2(filtered.data(), &size, stream.data(), &used), Z_OK) << "level " << level; // checks Adler-32
    EXPECT_EQ(size, 83u * (97u * 3u + 1u));
    EXPECT_EQ(used, stream.size());
  }
}

TEST(EncodePng, IsTheSameInAnyOrderAndOnAnyThread) {
  const Image image = picture(210, 151, 3, 6);
  for (int level = 0; level <= 9; ++level) {
    const PngFormat format{image.width, image.height, 3, level};
    const std::size_t stripeBytes = format.rowBytes() * format.stripeRows();
    const std::span<const std::uint8_t> rows(pixelsOf(image));
    std::vector<PngStripe> onOne(format.stripeCount());
    std::vector<PngStripe> onMany(format.stripeCount());
    const auto stripe = [&](std::size_t i) {
      const std::size_t first = i * stripeBytes;
      return pngStripe(format, rows.subspan(first, std::min(stripeBytes, rows.size() - first)));
    };
    for (std::size_t i = onOne.size(); i-- > 0;) onOne[i] = stripe(i);
    {
      std::vector<std::jthread> threads;
      for (std::size_t i = 0; i < onMany.size(); ++i) threads.emplace_back([&, i] { onMany[i] = stripe(i); });
    }
    const Bytes png = *encodePng(image, level);
    EXPECT_TRUE(assemblePng(format, onOne) == png) << "level " << level;
    EXPECT_TRUE(assemblePng(format, onMany) == png) << "level " << level;
  }
}

TEST(EncodePng, DependsOnItsArgumentsOnly) {
  const Image image{16, 16, {"R", "G", "B"}, Pixels(768, 77)};
  const auto first = encodePng(image, 0);
  const auto second = encodePng(image, 0);
  const auto smaller = encodePng(image, 9);
  ASSERT_TRUE(first && second && smaller);
  EXPECT_EQ(*first, *second);
  EXPECT_LT(smaller->size(), first->size());
}

TEST(EncodePng, RefusesWhatItCannotWrite) {
  EXPECT_FALSE(encodePng({1, 1, {"Y", "A"}, Pixels{1, 2}}, 2));
  EXPECT_FALSE(encodePng({2, 1, {"Y"}, Pixels{1}}, 2));
  EXPECT_FALSE(encodePng({0, 0, {"Y"}, Pixels{}}, 2));
  EXPECT_FALSE(encodePng({1, 1, {"Y"}, std::vector<float>{1}}, 2));
  EXPECT_FALSE(encodePng({1, 1, {"Y"}, Pixels{1}}, 10));
  EXPECT_FALSE(encodePng({1, 1, {"Y"}, Pixels{1}}, -1));
  EXPECT_FALSE(encodePng({1 << 28, 1, {"Y"}, Pixels{1}}, 2)) << "a stripe that no chunk holds";
}

} // namespace
} // namespace gnomon
