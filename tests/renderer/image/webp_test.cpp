#include <algorithm>
#include <cstdlib>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "renderer/image/image_codec.h"
#include "tests/renderer/image/oiio.h"
#include "tests/support/webp_builder.h"

namespace gnomon {
namespace {

using testing::losslessWebp;
using testing::webpCanvas;
using testing::webpChunk;
using testing::webpFile;

constexpr int kSide = 64;
constexpr std::int64_t kPixels = 4096;
constexpr std::size_t kChunk = 12; ///< where the first one of a file begins

/// A smooth picture, RGB.
Bytes ramp(int width, int height) {
  Bytes rgb;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (const int value : {40 + 4 * x, 200 - 4 * y, 90}) rgb.push_back(static_cast<std::uint8_t>(value));
    }
  }
  return rgb;
}

/// A lossy file of an opaque picture.
Bytes lossyWebp(int width, int height) {
  OIIO::ImageSpec spec(width, height, 3, OIIO::TypeUInt8);
  spec.attribute("compression", "webp:95");
  const Bytes bytes = writtenByOiio("webp", spec, OIIO::TypeUInt8, ramp(width, height).data());
  EXPECT_EQ(std::string(bytes.begin() + kChunk, bytes.begin() + kChunk + 4), "VP8 ");
  return bytes;
}

Bytes decoded(const Bytes& file) {
  auto image = decodeImage(file, kSide, kPixels);
  if (!image) {
    ADD_FAILURE() << image.problems().front().detail;
    return {};
  }
  return std::get<Bytes>(image->pixels);
}

TEST(DecodeWebp, GivesLosslessPixelsAsTheyWere) {
  EXPECT_TRUE(rc::check("decode(lossless(image)) == image", [] {
    const int width = *rc::gen::inRange(1, 9);
    const int height = *rc::gen::inRange(1, 9);
    const std::size_t count = static_cast<std::size_t>(width * height * 4);
    const auto pixels = *rc::gen::container<Bytes>(count, rc::gen::arbitrary<std::uint8_t>());
    const auto image = decodeImage(losslessWebp(width, height, pixels), kSide, kPixels);
    RC_ASSERT(bool(image));
    RC_ASSERT(image->width == width && image->height == height);
    RC_ASSERT(std::get<Bytes>(image->pixels) == pixels);
  }));
}

TEST(DecodeWebp, KeepsColourUnderTransparentPixels) {
  const Bytes pixels{250, 128, 3, 0, 250, 128, 3, 1, 9, 8, 7, 255};
  EXPECT_EQ(decoded(losslessWebp(3, 1, pixels)), pixels);
}

TEST(DecodeWebp, ReadsNoAlphaWhereItMeansNothing) {
  EXPECT_EQ(decoded(losslessWebp(1, 1, {250, 128, 3, 7}, false)), (Bytes{250, 128, 3, 255}));
}

TEST(DecodeWebp, ReadsLossyColour) {
  const Bytes rgb = ramp(32, 24);
  const Bytes rgba = decoded(lossyWebp(32, 24));
  ASSERT_EQ(rgba.size(), 32u * 24u * 4u);
  for (std::size_t i = 0; i < rgba.size(); ++i) {
    const int expected = i % 4 == 3 ? 255 : rgb[i / 4 * 3 + i % 4];
    ASSERT_LE(std::abs(rgba[i] - expected), 6) << i;
  }
}

TEST(DecodeWebp, AlphaBesideLossyColourChangesNoColour) {
  const Bytes opaque = lossyWebp(32, 24);
  Bytes alpha{0}; // stored, not compressed
  for (int i = 0; i < 32 * 24; ++i) alpha.push_back(static_cast<std::uint8_t>(i % 256));
  Bytes chunks = webpChunk("VP8X", webpCanvas(0x10, 32, 24));
  const Bytes alphaChunk = webpChunk("ALPH", alpha);
  chunks.insert(chunks.end(), alphaChunk.begin(), alphaChunk.end());
  chunks.insert(chunks.end(), opaque.begin() + kChunk, opaque.end());
  Bytes expected = decoded(opaque);
  for (std::size_t i = 3; i < expected.size(); i += 4) expected[i] = alpha[1 + i / 4];
  EXPECT_EQ(decoded(webpFile(chunks)), expected);
}

TEST(DecodeWebp, RefusesBombsByTheirHeaders) {
  const auto side = decodeImage(losslessWebp(16384, 16384, {}), 8192, 1 << 30);
  ASSERT_FALSE(side);
  EXPECT_EQ(side.problems().front().code, ProblemCode::tooLarge);
  EXPECT_EQ(side.problems().front().actual, "16384x16384");
  const auto pixels = decodeImage(losslessWebp(64, 64, {}), kSide, 4095);
  ASSERT_FALSE(pixels);
  EXPECT_EQ(pixels.problems().front().code, ProblemCode::tooLarge);
}

TEST(DecodeWebp, RefusesPixelsThatAreMissing) {
  const Bytes bitstream = testing::losslessBitstream(4, 4, Bytes(64, 77));
  for (std::size_t size = 5; size + 1 < bitstream.size(); ++size) {
    const auto end = bitstream.begin() + static_cast<std::ptrdiff_t>(size);
    const auto image = decodeImage(webpFile(webpChunk("VP8L", {bitstream.begin(), end})), kSide, kPixels);
    ASSERT_FALSE(image) << size;
    EXPECT_EQ(image.problems().front().code, ProblemCode::malformed);
  }
}

TEST(DecodeWebp, SurvivesEveryDamagedByte) {
  for (const Bytes& whole : {lossyWebp(9, 9), losslessWebp(4, 4, Bytes(64, 77))}) {
    for (std::size_t i = 0; i < whole.size(); ++i) {
      Bytes damaged = whole;
      damaged[i] ^= 0xff;
      const auto image = decodeImage(damaged, kSide, kPixels);
      if (!image) continue;
      ASSERT_EQ(std::get<Bytes>(image->pixels).size(),
                static_cast<std::size_t>(image->width) * static_cast<std::size_t>(image->height) * 4u);
    }
  }
}

/// A JPEG of one colour (three values) or grey (one value).
Bytes makeJpeg(int width, int height, const std::vector<std::uint8_t>& color, bool progressive) {
  OIIO::ImageSpec spec(width, height, static_cast<int>(color.size()), OIIO::TypeUInt8);
  spec.attribute("compression", "jpeg:95");
  spec.attribute("jpeg:progressive", progressive ? 1 : 0);
  spec.attribute("ImageDescription", "metadata that the pixels do not depend on");
  spec.attribute("Orientation", 6);
  std::vector<std::uint8_t> pixels;
  for (int i = 0; i < width * height; ++i) pixels.insert(pixels.end(), color.begin(), color.end());
  return writtenByOiio("jpeg", spec, OIIO::TypeUInt8, pixels.data());
}

TEST(DecodeJpeg, ReadsColourAndGreyBaselineAndProgressive) {
  for (const bool progressive : {false, true}) {
    for (const auto& color : std::vector<std::vector<std::uint8_t>>{{200, 100, 50}, {77}}) {
      const Bytes jpeg = makeJpeg(20, 12, color, progressive);
      const auto size = imageSize(jpeg);
      ASSERT_TRUE(size);
      EXPECT_EQ(size->width, 20);
      EXPECT_EQ(size->height, 12);
      const auto image = decodeImage(jpeg, 64, 4096);
      ASSERT_TRUE(image) << image.problems().front().detail;
      EXPECT_EQ(image->width, 20) << "an orientation tag must not turn the picture";
      const auto& pixels = std::get<std::vector<std::uint8_t>>(image->pixels);
      ASSERT_EQ(pixels.size(), 20u * 12u * 4u);
      for (std::size_t i = 0; i < pixels.size(); ++i) {
        const int expected = i % 4 == 3 ? 255 : color[color.size() == 1 ? 0 : i % 4];
        ASSERT_LE(std::abs(pixels[i] - expected), 2) << i;
      }
    }
  }
}

TEST(DecodeJpeg, PixelsAreThoseOfOpenImageIO) {
  for (const bool progressive : {false, true}) {
    for (const char* subsampling : {"4:4:4", "4:2:2", "4:2:0"}) {
      OIIO::ImageSpec spec(61, 43, 3, OIIO::TypeUInt8);
      spec.attribute("compression", "jpeg:80");
      spec.attribute("jpeg:progressive", progressive ? 1 : 0);
      spec.attribute("jpeg:subsampling", subsampling);
      std::vector<std::uint8_t> pixels(61 * 43 * 3);
      std::uint32_t random = 1;
      for (std::size_t i = 0; i < pixels.size(); ++i) {
        random = random * 1664525u + 1013904223u;
        pixels[i] = static_cast<std::uint8_t>((i / 7 + (random >> 26)) & 255u);
      }
      const Bytes bytes = writtenByOiio("jpeg", spec, OIIO::TypeUInt8, pixels.data());
      const OiioFile file("jpeg", bytes);
      ASSERT_TRUE(file.input && file.input->read_image(0, 0, 0, 3, OIIO::TypeUInt8, pixels.data()));
      const auto image = decodeImage(bytes, 64, 4096);
      ASSERT_TRUE(image) << image.problems().front().detail;
      const auto& rgba = std::get<std::vector<std::uint8_t>>(image->pixels);
      for (std::size_t i = 0; i < pixels.size(); ++i) ASSERT_EQ(rgba[i / 3 * 4 + i % 3], pixels[i]) << subsampling;
    }
  }
}

TEST(DecodeJpeg, RefusesEveryTruncation) {
  for (const bool progressive : {false, true}) {
    const Bytes whole = makeJpeg(9, 9, {200, 100, 50}, progressive);
    ASSERT_TRUE(decodeImage(whole, 64, 4096));
    for (std::size_t size = 0; size < whole.size(); ++size) {
      ASSERT_FALSE(decodeImage(std::span(whole).first(size), 64, 4096)) << size << " of " << whole.size();
    }
  }
}

TEST(DecodeJpeg, RefusesBombsByTheirHeaders) {
  Bytes jpeg = makeJpeg(9, 9, {77}, false);
  const auto image = decodeImage(jpeg, 8, 4096);
  ASSERT_FALSE(image);
  EXPECT_EQ(image.problems().front().code, ProblemCode::tooLarge);
  EXPECT_EQ(image.problems().front().actual, "9x9");
}

TEST(DecodeJpeg, SurvivesEveryDamagedByte) {
  const Bytes whole = makeJpeg(9, 9, {200, 100, 50}, false);
  for (std::size_t i = 0; i < whole.size(); ++i) {
    Bytes damaged = whole;
    damaged[i] ^= 0xff;
    const auto image = decodeImage(damaged, 64, 4096);
    if (!image) continue;
    ASSERT_EQ(std::get<std::vector<std::uint8_t>>(image->pixels).size(),
              static_cast<std::size_t>(image->width) * static_cast<std::size_t>(image->height) * 4u);
  }
}

} // namespace
} // namespace gnomon
