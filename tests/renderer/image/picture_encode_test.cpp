// What the encoders of pictures wrote, read back with OpenImageIO.
#include "renderer/image/picture_encode.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <cmath>
#include <cstdlib>
#include <gtest/gtest.h>

#include "renderer/image/image_codec.h"
#include "tests/renderer/image/oiio.h"

namespace gnomon {
namespace {

using Words = std::vector<std::uint16_t>;

/// The samples as the file has them.
template <class Number>
std::vector<Number> read(const Result<Bytes>& file, const char* format, OIIO::ImageSpec& spec) {
  EXPECT_TRUE(file) << (file ? "" : file.problems().front().detail);
  if (!file) return {};
  OiioFile opened(format, *file);
  spec = opened.spec;
  if (!opened.input) return {};
  std::vector<Number> samples(spec.image_pixels() * static_cast<std::size_t>(spec.nchannels));
  EXPECT_TRUE(opened.input->read_image(0, 0, 0, spec.nchannels, OIIO::BaseTypeFromC<Number>::value, samples.data()));
  return samples;
}

const std::vector<std::string>& names(std::size_t count) {
  static const std::vector<std::string> grey{"Y"}, xy{"X", "Y"}, rgb{"R", "G", "B"}, rgba{"R", "G", "B", "A"};
  return count == 1 ? grey : count == 2 ? xy : count == 3 ? rgb : rgba;
}

template <class Number>
Image ramp(int width, int height, std::size_t channels, double step) {
  std::vector<Number> pixels(static_cast<std::size_t>(width * height) * channels);
  for (std::size_t i = 0; i < pixels.size(); ++i) pixels[i] = static_cast<Number>(static_cast<double>(i) * step);
  return {width, height, names(channels), std::move(pixels)};
}

TEST(EncodePng16, ComesBackAsItWas) {
  for (const std::size_t channels : {1u, 3u, 4u}) {
    for (const auto& [width, height] : {std::pair(1, 1), std::pair(7, 70), std::pair(131, 5)}) {
      for (const int level : {0, 2, 6}) {
        const Image image = ramp<std::uint16_t>(width, height, channels, 257.3);
        OIIO::ImageSpec spec;
        EXPECT_EQ(read<std::uint16_t>(encodePng(image, level), "png", spec), std::get<Words>(image.pixels));
        EXPECT_EQ(spec.format, OIIO::TypeUInt16);
        EXPECT_EQ(spec.nchannels, static_cast<int>(channels));
      }
    }
  }
}

TEST(EncodeTiff, KeepsEveryFloat) {
  for (const std::size_t channels : {1u, 2u, 3u}) {
    for (const auto& [width, height] : {std::pair(1, 1), std::pair(333, 700)}) {
      Image image = ramp<float>(width, height, channels, -0.37);
      std::get<std::vector<float>>(image.pixels)[0] = INFINITY;
      OIIO::ImageSpec spec;
      EXPECT_EQ(read<float>(encodeTiff(image), "tiff", spec), std::get<std::vector<float>>(image.pixels));
      EXPECT_EQ(spec.format, OIIO::TypeFloat);
      EXPECT_EQ(spec.width, width);
      EXPECT_EQ(spec.height, height);
      EXPECT_EQ(spec.nchannels, static_cast<int>(channels));
      EXPECT_EQ(spec.get_string_attribute("DateTime", "none"), "none");
    }
  }
}

TEST(EncodeTiff, AssociatesAlphaAsAnExrDoes) {
  const Image image{1, 1, names(4), std::vector<float>{8, 4, 2, 0.25f}};
  OIIO::ImageSpec spec;
  EXPECT_EQ(read<float>(encodeTiff(image), "tiff", spec), (std::vector<float>{2, 1, 0.5f, 0.25f}));
  EXPECT_EQ(spec.alpha_channel, 3);
  EXPECT_EQ(spec.get_int_attribute("oiio:UnassociatedAlpha", 0), 0);
}

TEST(EncodeTiff, RefusesWhatItCantHold) {
  EXPECT_FALSE(encodeTiff({1, 1, names(1), Bytes{1}}));
  EXPECT_FALSE(encodeTiff({2, 1, names(1), std::vector<float>{1}}));
}

/// Slopes in every channel, and alpha.
Image slopes(int width, int height, std::size_t channels) {
  Bytes pixels;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const int values[]{x * 255 / width, y * 255 / height, 255 - x * 255 / width, 100 + x * 100 / width};
      for (std::size_t c = 0; c < channels; ++c) pixels.push_back(static_cast<std::uint8_t>(values[c]));
    }
  }
  return {width, height, names(channels), std::move(pixels)};
}

/// The mean difference of the first `channels` channels; of the file, those that it has.
double difference(const Bytes& wanted, std::size_t wantedStep, const Bytes& got, std::size_t gotStep,
                  std::size_t channels) {
  EXPECT_EQ(wanted.size() / wantedStep, got.size() / gotStep);
  double sum = 0;
  const std::size_t pixels = std::min(wanted.size() / wantedStep, got.size() / gotStep);
  for (std::size_t i = 0; i < pixels; ++i) {
    for (std::size_t c = 0; c < channels; ++c) {
      const int want = wanted[i * wantedStep + std::min(c, wantedStep - 1)];
      sum += std::abs(want - got[i * gotStep + c]);
    }
  }
  return sum / static_cast<double>(pixels * channels);
}

TEST(EncodeJpeg, IsCloseAtFullColorResolution) {
  for (const std::size_t channels : {1u, 3u, 4u}) {
    const Image image = slopes(161, 93, channels);
    OIIO::ImageSpec spec;
    const Bytes read90 = read<std::uint8_t>(encodeJpeg(image, 90), "jpeg", spec);
    EXPECT_EQ(spec.nchannels, channels == 1 ? 1 : 3) << "alpha is left out";
    const std::size_t step = static_cast<std::size_t>(spec.nchannels);
    EXPECT_LT(difference(std::get<Bytes>(image.pixels), channels, read90, step, step), 1.5) << channels;
    if (channels > 1) {
      EXPECT_EQ(spec.get_string_attribute("jpeg:subsampling"), "4:4:4");
    }
  }
  EXPECT_LT(encodeJpeg(slopes(161, 93, 3), 10)->size(), encodeJpeg(slopes(161, 93, 3), 100)->size());
  OIIO::ImageSpec spec;
  EXPECT_EQ(read<std::uint8_t>(encodeJpeg({1, 1, names(1), Bytes{200}}, 100), "jpeg", spec), Bytes{200});
}

TEST(EncodeJpeg, RefusesWhatIsNoPicture) {
  EXPECT_FALSE(encodeJpeg({1, 1, names(1), std::vector<float>{1}}, 90));
  EXPECT_FALSE(encodeJpeg({2, 1, names(1), Bytes{1}}, 90));
  const auto wide = encodeJpeg({70'000, 1, names(1), Bytes(70'000)}, 90);
  ASSERT_FALSE(wide) << "65,500 pixels are the library's most";
  EXPECT_NE(wide.problems().front().detail.find("65500"), std::string::npos) << wide.problems().front().detail;
}

TEST(EncodeWebp, IsCloseAndKeepsAlpha) {
  for (const std::size_t channels : {1u, 3u, 4u}) {
    const Image image = slopes(161, 93, channels);
    const auto file = encodeWebp(image, 90);
    ASSERT_TRUE(file) << file.problems().front().detail;
    const auto back = decodeImage(*file, 1000, 1'000'000); // OpenImageIO multiplies by alpha
    ASSERT_TRUE(back) << back.problems().front().detail;
    const Bytes& rgba = std::get<Bytes>(back->pixels);
    EXPECT_LT(difference(std::get<Bytes>(image.pixels), channels, rgba, 4, 3), 3.0) << channels;
    for (std::size_t i = 0; i < rgba.size() / 4; ++i) {
      ASSERT_EQ(rgba[i * 4 + 3], channels == 4 ? std::get<Bytes>(image.pixels)[i * 4 + 3] : 255) << i;
    }
  }
  OIIO::ImageSpec spec;
  const Bytes opaque = read<std::uint8_t>(encodeWebp(slopes(161, 93, 3), 90), "webp", spec);
  EXPECT_EQ(spec.width, 161);
  EXPECT_EQ(spec.nchannels, 3);
  EXPECT_LT(difference(std::get<Bytes>(slopes(161, 93, 3).pixels), 3, opaque, 3, 3), 3.0);
  EXPECT_LT(encodeWebp(slopes(161, 93, 3), 0)->size(), encodeWebp(slopes(161, 93, 3), 100)->size());
}

TEST(EncodeWebp, RefusesWhatNoneHolds) {
  const auto wide = encodeWebp({16384, 1, names(1), Bytes(16384)}, 90);
  ASSERT_FALSE(wide);
  EXPECT_EQ(wide.problems().front().code, ProblemCode::tooLarge);
  EXPECT_EQ(wide.problems().front().actual, "16384x1");
  EXPECT_TRUE(encodeWebp({16383, 1, names(1), Bytes(16383)}, 90));
  EXPECT_FALSE(encodeWebp({1, 1, names(1), std::vector<float>{1}}, 90));
}

TEST(EncodePictures, EqualImagesGiveEqualBytes) {
  const Image image = slopes(333, 222, 4);
  EXPECT_EQ(*encodeJpeg(image, 90), *encodeJpeg(image, 90));
  EXPECT_EQ(*encodeWebp(image, 90), *encodeWebp(image, 90));
  const Image numbers = ramp<float>(333, 222, 4, 0.1);
  EXPECT_EQ(*encodeTiff(numbers), *encodeTiff(numbers));
}

} // namespace
} // namespace gnomon
