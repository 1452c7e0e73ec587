#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <algorithm>
#include <cstdlib>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "renderer/image/image_codec.h"
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
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  const auto output = OIIO::ImageOutput::create("webp");
  const Bytes rgb = ramp(width, height);
  EXPECT_TRUE(output && output->set_ioproxy(&memory) && output->open("webp", spec) &&
              output->write_image(OIIO::TypeUInt8, rgb.data()) && output->close());
  EXPECT_EQ(std::string(bytes.begin() + kChunk, bytes.begin() + kChunk + 4), "VP8 ");
  return {bytes.begin(), bytes.end()};
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

} // namespace
} // namespace gnomon
