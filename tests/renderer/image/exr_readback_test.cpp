#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <cmath>
#include <gtest/gtest.h>
#include <map>

#include "renderer/image/image_codec.h"
#include "renderer/image/png_encode.h"

namespace gnomon {
namespace {

/// One part of an EXR as OpenImageIO sees it.
struct ReadPart {
  OIIO::ImageSpec spec;
  std::map<std::string, std::vector<float>> channels;
};

std::vector<ReadPart> readExr(const Bytes& exr) {
  Bytes bytes = exr;
  OIIO::Filesystem::IOMemReader memory(bytes.data(), bytes.size());
  const auto input = OIIO::ImageInput::create("openexr");
  OIIO::ImageSpec spec;
  if (!input || !input->set_ioproxy(&memory) || !input->open("exr", spec)) {
    ADD_FAILURE() << "the EXR does not open: " << (input ? input->geterror() : OIIO::geterror());
    return {};
  }
  std::vector<ReadPart> parts;
  for (int i = 0; input->seek_subimage(i, 0); ++i) {
    ReadPart part{input->spec(i), {}};
    const auto channelCount = static_cast<std::size_t>(part.spec.nchannels);
    std::vector<float> pixels(part.spec.image_pixels() * channelCount);
    EXPECT_TRUE(input->read_image(i, 0, 0, part.spec.nchannels, OIIO::TypeFloat, pixels.data()));
    for (std::size_t from = 0; from < pixels.size(); ++from) {
      part.channels[part.spec.channelnames[from % channelCount]].push_back(pixels[from]);
    }
    parts.push_back(std::move(part));
  }
  return parts;
}

Image ramp(int width, int height, std::vector<std::string> channels) {
  std::vector<float> pixels(static_cast<std::size_t>(width * height) * channels.size());
  for (std::size_t i = 0; i < pixels.size(); ++i) pixels[i] = static_cast<float>(i) * 0.25f;
  return {width, height, std::move(channels), std::move(pixels)};
}

const std::vector<ExrCompression> kCompressions{ExrCompression::none, ExrCompression::rle, ExrCompression::zip,
                                                ExrCompression::piz};

TEST(EncodeExr, NamesItsLayersAndParts) {
  const Image color = ramp(4, 2, {"R", "G", "B"});
  const Image depth = ramp(4, 2, {"Z"});
  const Image atlas = ramp(3, 5, {"Z"});
  const std::vector<ImageLayer> layers{{"", &color}, {"depth", &depth, true}, {"atlas", &atlas, true}};
  const auto exr = encodeExr(layers, ExrCompression::zip, ExrPixelType::half);
  ASSERT_TRUE(exr) << exr.problems().front().detail;
  const auto parts = readExr(*exr);
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_EQ(parts[0].spec.width, 4);
  EXPECT_EQ(parts[0].spec.height, 2);
  ASSERT_EQ(parts[0].channels.size(), 4u);
  EXPECT_EQ(parts[0].channels.at("R"), (std::vector<float>{0, 0.75f, 1.5f, 2.25f, 3, 3.75f, 4.5f, 5.25f}));
  EXPECT_EQ(parts[0].channels.at("depth.Z"), std::get<std::vector<float>>(depth.pixels));
  EXPECT_EQ(parts[1].spec.width, 3);
  EXPECT_EQ(parts[1].spec.full_width, 4) << "one display window, as EXR demands";
  EXPECT_EQ(parts[1].spec.get_string_attribute("oiio:subimagename"), "atlas");
  EXPECT_EQ(parts[1].channels.at("atlas.Z"), std::get<std::vector<float>>(atlas.pixels));
}

TEST(EncodeExr, WritesAllPixelTypesAndCompressions) {
  const Image color = ramp(5, 3, {"R", "G", "B"});
  const std::vector<ImageLayer> layers{{"", &color}};
  const std::vector<std::string> names{"none", "rle", "zip", "piz"};
  for (std::size_t i = 0; i < kCompressions.size(); ++i) {
    for (const ExrPixelType type : {ExrPixelType::half, ExrPixelType::float_}) {
      const auto exr = encodeExr(layers, kCompressions[i], type);
      ASSERT_TRUE(exr) << exr.problems().front().detail;
      const auto parts = readExr(*exr);
      ASSERT_EQ(parts.size(), 1u);
      EXPECT_EQ(parts[0].spec.get_string_attribute("compression"), names[i]);
      EXPECT_EQ(parts[0].spec.format, type == ExrPixelType::half ? OIIO::TypeHalf : OIIO::TypeFloat);
      EXPECT_EQ(parts[0].channels.at("G")[1], 1.0f);
    }
  }
}

TEST(EncodeExr, KeepsDepthExactBesideHalfColour) {
  const Image color = ramp(1, 1, {"R", "G", "B"});
  const Image depth{1, 1, {"Z"}, std::vector<float>{123.456789f}};
  const std::vector<ImageLayer> layers{{"", &color}, {"", &depth, true}};
  const auto exr = encodeExr(layers, ExrCompression::piz, ExrPixelType::half);
  ASSERT_TRUE(exr) << exr.problems().front().detail;
  const auto parts = readExr(*exr);
  ASSERT_EQ(parts.size(), 1u);
  EXPECT_EQ(parts[0].channels.at("Z").front(), 123.456789f);
}

TEST(EncodeExr, AssociatesAlpha) {
  const Image color{1, 1, {"R", "G", "B", "A"}, std::vector<float>{8, 4, 2, 0.25f}};
  const std::vector<ImageLayer> layers{{"", &color}};
  const auto exr = encodeExr(layers, ExrCompression::none, ExrPixelType::half);
  ASSERT_TRUE(exr) << exr.problems().front().detail;
  const auto parts = readExr(*exr);
  ASSERT_EQ(parts.size(), 1u);
  EXPECT_EQ(parts[0].channels.at("R").front(), 2.0f);
  EXPECT_EQ(parts[0].channels.at("B").front(), 0.5f);
  EXPECT_EQ(parts[0].channels.at("A").front(), 0.25f);
}

TEST(EncodeExr, KeepsInfinityAndNegativeValues) {
  const Image depth{3, 1, {"Z"}, std::vector<float>{INFINITY, -1.5f, 1e-30f}};
  const std::vector<ImageLayer> layers{{"", &depth}};
  for (const ExrCompression compression : kCompressions) {
    const auto exr = encodeExr(layers, compression, ExrPixelType::float_);
    ASSERT_TRUE(exr) << exr.problems().front().detail;
    EXPECT_EQ(readExr(*exr).at(0).channels.at("Z"), std::get<std::vector<float>>(depth.pixels));
  }
}

TEST(EncodeExr, HoldsNoTimeOfDay) {
  const Image color = ramp(4, 2, {"R", "G", "B"});
  const Image atlas = ramp(2, 2, {"Z"});
  const std::vector<ImageLayer> layers{{"", &color}, {"atlas", &atlas}};
  const auto first = encodeExr(layers, ExrCompression::piz, ExrPixelType::half);
  const auto second = encodeExr(layers, ExrCompression::piz, ExrPixelType::half);
  ASSERT_TRUE(first && second);
  EXPECT_EQ(*first, *second);
  for (const ReadPart& part : readExr(*first)) {
    EXPECT_EQ(part.spec.get_string_attribute("DateTime"), "2000:01:01 00:00:00");
    EXPECT_EQ(part.spec.get_string_attribute("capDate", "none"), "none");
  }
}

TEST(EncodePng, SaysThatItIsSrgb) {
  const auto png = encodePng({1, 1, {"R", "G", "B"}, std::vector<std::uint8_t>{1, 2, 3}}, 2);
  ASSERT_TRUE(png);
  const std::string text(png->begin(), png->end());
  EXPECT_NE(text.find("sRGB"), std::string::npos);
  EXPECT_EQ(text.find("tIME"), std::string::npos);
}

} // namespace
} // namespace gnomon
