#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <cstdlib>
#include <gtest/gtest.h>

#include "renderer/image/image_codec.h"

namespace gnomon {
namespace {

/// A JPEG of one colour (three values) or grey (one value).
Bytes makeJpeg(int width, int height, const std::vector<std::uint8_t>& color, bool progressive) {
  OIIO::ImageSpec spec(width, height, static_cast<int>(color.size()), OIIO::TypeUInt8);
  spec.attribute("compression", "jpeg:95");
  spec.attribute("jpeg:progressive", progressive ? 1 : 0);
  spec.attribute("ImageDescription", "metadata that the pixels do not depend on");
  spec.attribute("Orientation", 6);
  std::vector<std::uint8_t> pixels;
  for (int i = 0; i < width * height; ++i) pixels.insert(pixels.end(), color.begin(), color.end());
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  const auto output = OIIO::ImageOutput::create("jpeg");
  EXPECT_TRUE(output && output->set_ioproxy(&memory) && output->open("jpg", spec) &&
              output->write_image(OIIO::TypeUInt8, pixels.data()) && output->close());
  return {bytes.begin(), bytes.end()};
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
      std::vector<unsigned char> bytes;
      OIIO::Filesystem::IOVecOutput out(bytes);
      const auto output = OIIO::ImageOutput::create("jpeg");
      ASSERT_TRUE(output && output->set_ioproxy(&out) && output->open("jpg", spec) &&
                  output->write_image(OIIO::TypeUInt8, pixels.data()) && output->close());
      OIIO::Filesystem::IOMemReader in(bytes.data(), bytes.size());
      const auto input = OIIO::ImageInput::create("jpeg");
      OIIO::ImageSpec read;
      ASSERT_TRUE(input && input->set_ioproxy(&in) && input->open("jpg", read) &&
                  input->read_image(0, 0, 0, 3, OIIO::TypeUInt8, pixels.data()));
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
