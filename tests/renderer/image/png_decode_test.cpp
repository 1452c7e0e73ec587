#include <gtest/gtest.h>
#include <random>
#include <zlib.h>

#include "renderer/image/image_codec.h"
#include "renderer/image/picture_decode.h"
#include "tests/renderer/image/oiio.h"
#include "tests/renderer/image/png_builder.h"
#include "tests/renderer/image/rows_of.h"

namespace gnomon {
namespace {

struct Kind {
  int colorType, bitDepth, channels;
};
constexpr Kind kKinds[]{{0, 1, 1}, {0, 2, 1}, {0, 4, 1}, {0, 8, 1}, {0, 16, 1}, {2, 8, 3}, {2, 16, 3}, {3, 1, 1},
                        {3, 2, 1}, {3, 4, 1}, {3, 8, 1}, {4, 8, 2}, {4, 16, 2}, {6, 8, 4}, {6, 16, 4}};

constexpr std::size_t kAdam7[7][4]{{0, 0, 8, 8}, {4, 0, 8, 8}, {0, 4, 4, 8}, {2, 0, 4, 4},
                                   {0, 2, 2, 4}, {1, 0, 2, 2}, {0, 1, 1, 2}};

std::size_t stepsIn(std::size_t size, std::size_t first, std::size_t step) {
  return size > first ? (size - first + step - 1) / step : 0;
}

class RandomPng {
 public:
  explicit RandomPng(unsigned seed) : random_(seed) {}

  std::uint8_t byte() { return static_cast<std::uint8_t>(random_() >> 13); }

  /// Random bytes behind random filters; the compressed data are cut into several chunks.
  Bytes make(const Kind& kind, std::size_t width, std::size_t height, bool interlaced, bool transparent) {
    Bytes header;
    for (const std::size_t side : {width, height}) {
      for (int shift = 24; shift >= 0; shift -= 8) header.push_back(static_cast<std::uint8_t>(side >> shift));
    }
    for (const int value : {kind.bitDepth, kind.colorType, 0, 0, interlaced ? 1 : 0}) {
      header.push_back(static_cast<std::uint8_t>(value));
    }
    Bytes png{0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
    add(png, "IHDR", header);
    const std::size_t colors = std::size_t{1} << (kind.colorType == 3 ? kind.bitDepth : 0);
    if (kind.colorType == 3) add(png, "PLTE", bytes(3 * colors));
    if (transparent && kind.colorType == 3) add(png, "tRNS", bytes(colors / 2));
    if (transparent && kind.colorType == 0) add(png, "tRNS", {0, 1});
    if (transparent && kind.colorType == 2) add(png, "tRNS", {0, 1, 0, 1, 0, 1});
    const Bytes raw = rowsOf(kind, width, height, interlaced);
    uLongf size = compressBound(raw.size());
    Bytes packed(size);
    EXPECT_EQ(compress2(packed.data(), &size, raw.data(), raw.size(), 6), Z_OK);
    packed.resize(size);
    for (std::size_t at = 0; at < packed.size(); at += 1000) {
      const auto first = packed.begin() + static_cast<std::ptrdiff_t>(at);
      add(png, "IDAT",
          Bytes(first, first + static_cast<std::ptrdiff_t>(std::min<std::size_t>(1000, packed.size() - at))));
      if (at == 0) add(png, "IDAT", {});
    }
    add(png, "IEND", {});
    return png;
  }

 private:
  static void add(Bytes& png, const std::string& type, const Bytes& data) {
    const Bytes chunk = pngChunk(type, data);
    png.insert(png.end(), chunk.begin(), chunk.end());
  }

  Bytes bytes(std::size_t count) {
    Bytes all(count);
    for (std::uint8_t& each : all) each = byte();
    return all;
  }

  Bytes rowsOf(const Kind& kind, std::size_t width, std::size_t height, bool interlaced) {
    Bytes raw;
    for (std::size_t pass = 0; pass < (interlaced ? 7 : 1); ++pass) {
      const auto& p = kAdam7[pass];
      const std::size_t columns = interlaced ? stepsIn(width, p[0], p[2]) : width;
      const std::size_t rows = interlaced ? stepsIn(height, p[1], p[3]) : height;
      const std::size_t rowBytes = (columns * static_cast<std::size_t>(kind.bitDepth * kind.channels) + 7) / 8;
      for (std::size_t i = 0; columns > 0 && i < rows; ++i) {
        raw.push_back(byte() % 5);
        const Bytes row = bytes(rowBytes);
        // Small numbers, too, so that a transparent color is met.
        for (const std::uint8_t each : row) raw.push_back(i % 3 == 0 ? each % 2 : each);
      }
    }
    return raw;
  }

  std::mt19937 random_;
};

/// As libpng reads it.
Bytes byLibpng(const Bytes& png, std::size_t width, std::size_t height) {
  OiioFile file("png", png);
  if (!file.input) return {};
  Bytes read(width * height * static_cast<std::size_t>(file.spec.nchannels));
  EXPECT_TRUE(file.input->read_image(0, 0, 0, file.spec.nchannels, OIIO::TypeUInt8, read.data()));
  Bytes rgba;
  const auto channels = static_cast<std::size_t>(file.spec.nchannels);
  for (std::size_t i = 0; i < width * height; ++i) {
    const std::uint8_t* pixel = &read[i * channels];
    for (std::size_t c = 0; c < 3; ++c) rgba.push_back(pixel[channels < 3 ? 0 : c]);
    rgba.push_back(channels % 2 == 0 ? pixel[channels - 1] : 255);
  }
  return rgba;
}

TEST(DecodePngPixels, AreThoseOfLibpngForEveryKind) {
  RandomPng random(1);
  for (const Kind& kind : kKinds) {
    for (const bool interlaced : {false, true}) {
      for (const bool transparent : {false, true}) {
        for (int i = 0; i < 12; ++i) {
          const std::size_t width = i < 4 ? static_cast<std::size_t>(i + 1) : 1 + random.byte();
          const std::size_t height = i < 4 ? static_cast<std::size_t>(5 - i) : 1 + random.byte() / 2;
          const Bytes png = random.make(kind, width, height, interlaced, transparent);
          const auto image = decodeImage(png, 512, 512 * 512);
          ASSERT_TRUE(image) << image.problems().front().detail;
          ASSERT_TRUE(std::get<0>(image->pixels) == byLibpng(png, width, height))
              << "color type " << kind.colorType << ", " << kind.bitDepth << " bits, " << width << " x " << height
              << (interlaced ? ", interlaced" : "") << (transparent ? ", transparent" : "");
          ASSERT_EQ(rowsOf(png, 16), std::get<0>(image->pixels));
        }
      }
    }
  }
}

TEST(DecodePngPixels, SurviveDamageThatTheChecksumsDoNotTell) {
  RandomPng random(2);
  int broken = 0;
  for (int i = 0; i < 3000; ++i) {
    const Kind& kind = kKinds[static_cast<std::size_t>(i) % std::size(kKinds)];
    const Bytes whole = random.make(kind, 30, 20, i % 2 == 0, i % 3 == 0);
    auto checked = checkImage(whole, 64, 4096);
    ASSERT_TRUE(checked);
    // The first IDAT's data, and then its checksum made right.
    Bytes& file = checked->picture.bytes;
    const std::string text(file.begin(), file.end());
    const std::size_t type = text.find("IDAT");
    const std::size_t length = bigEndian(file, type - 4, 4);
    file[type + 4 + random.byte() % length] ^= static_cast<std::uint8_t>(1u << random.byte() % 8);
    const Bytes chunk = pngChunk("IDAT", Bytes(file.begin() + static_cast<std::ptrdiff_t>(type + 4),
                                               file.begin() + static_cast<std::ptrdiff_t>(type + 4 + length)));
    std::copy(chunk.begin(), chunk.end(), file.begin() + static_cast<std::ptrdiff_t>(type - 4));
    if (!decodeImage(*checked).wrong.empty()) ++broken;
  }
  EXPECT_GT(broken, 100);
}

} // namespace
} // namespace gnomon
