#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <map>
#include <rapidcheck/gtest.h>

#include "renderer/image/image_codec.h"
#include "renderer/image/picture_encode.h"
#include "tests/renderer/image/oiio.h"

namespace gnomon {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr int kSide = 64;
constexpr std::int64_t kValues = 1 << 16;

Image counted(int width, int height, std::vector<std::string> channels) {
  std::vector<float> pixels(static_cast<std::size_t>(width * height) * channels.size());
  for (std::size_t i = 0; i < pixels.size(); ++i) pixels[i] = static_cast<float>(i) * 0.5f;
  return {width, height, std::move(channels), std::move(pixels)};
}

Bytes someExr() {
  const Image color = counted(4, 3, {"R", "G", "B"}), depth = counted(4, 3, {"Z"}), atlas = counted(3, 5, {"Z"});
  const std::vector<ImageLayer> layers{{"", &color}, {"depth", &depth, true}, {"atlas", &atlas, true}};
  return *encodeExr(layers, ExrCompression::zip, ExrPixelType::float_);
}

/// Written in tiles, by another library.
Bytes tiledExr() {
  OIIO::ImageSpec spec(5, 3, 2, OIIO::TypeHalf);
  spec.channelnames = {"A", "R"};
  spec.tile_width = spec.tile_height = 2;
  const Image picture = counted(5, 3, {"A", "R"});
  return writtenByOiio("openexr", spec, OIIO::TypeFloat, std::get<std::vector<float>>(picture.pixels).data());
}

TEST(DecodeExr, GivesEveryLayerByItsName) {
  const auto layers = decodeExr(someExr(), kSide, kValues);
  ASSERT_TRUE(layers) << layers.problems().front().detail;
  std::vector<std::string> names;
  for (const ExrLayer& layer : *layers) names.push_back(layer.name);
  EXPECT_THAT(names, ElementsAre("main", "depth", "atlas"));
  EXPECT_THAT((*layers)[0].image.channels, ElementsAre("R", "G", "B"));
  EXPECT_EQ((*layers)[0].image.pixels, counted(4, 3, {"R", "G", "B"}).pixels);
  EXPECT_EQ((*layers)[1].image.pixels, counted(4, 3, {"Z"}).pixels);
  EXPECT_EQ((*layers)[2].image.height, 5);
  EXPECT_EQ((*layers)[2].image.pixels, counted(3, 5, {"Z"}).pixels);
}

TEST(DecodeExr, PlainChannelsBesideALayerAreNotPartOfIt) {
  const Image color = counted(4, 3, {"R", "G", "B"}), depth = counted(4, 3, {"Z"});
  const std::vector<ImageLayer> layers{{"depth", &depth, true}, {"", &color}}; // the part has the first one's name
  const auto read = decodeExr(*encodeExr(layers, ExrCompression::zip, ExrPixelType::float_), kSide, kValues);
  ASSERT_TRUE(read);
  ASSERT_EQ(read->size(), 2u);
  EXPECT_EQ((*read)[0].name, "main");
  EXPECT_EQ((*read)[1].name, "depth");
  EXPECT_THAT((*read)[1].image.channels, ElementsAre("Z"));
}

TEST(DecodeExr, ReadsTilesAndHalfsWithRedBeforeAlpha) {
  const auto layers = decodeExr(tiledExr(), kSide, kValues);
  ASSERT_TRUE(layers) << layers.problems().front().detail;
  ASSERT_EQ(layers->size(), 1u);
  const Image& image = layers->front().image;
  EXPECT_THAT(image.channels, ElementsAre("R", "A"));
  const auto& pixels = std::get<std::vector<float>>(image.pixels);
  ASSERT_EQ(pixels.size(), 30u);
  EXPECT_EQ(pixels[0], 0.5f); // red is the second number of each pixel there
  EXPECT_EQ(pixels[1], 0);
  EXPECT_EQ(pixels[28], 14.5f);
}

TEST(DecodeExr, WhatIsTooLargeIsRefused) {
  const Bytes file = someExr();
  const auto wide = decodeExr(file, 4, kValues);
  ASSERT_FALSE(wide);
  EXPECT_EQ(wide.problems()[0].actual, "3x5");
  const auto many = decodeExr(file, kSide, 40);
  ASSERT_FALSE(many);
  EXPECT_THAT(many.problems()[0].detail, HasSubstr("too many numbers"));
}

TEST(DecodeExr, EveryBeginningOfAFileIsRefused) {
  const Bytes file = someExr();
  for (std::size_t size = 0; size < file.size(); size += 7) {
    EXPECT_FALSE(decodeExr(std::span(file).first(size), kSide, kValues)) << size;
  }
}

RC_GTEST_PROP(DecodeExr, DamageIsSurvived, ()) {
  static const Bytes tiled = tiledExr(), parts = someExr();
  Bytes file = *rc::gen::element(tiled, parts);
  for (int i = *rc::gen::inRange(1, 8); i > 0; --i) {
    file[*rc::gen::inRange<std::size_t>(4, file.size())] = *rc::gen::arbitrary<std::uint8_t>();
  }
  const auto layers = decodeExr(file, kSide, kValues);
  if (!layers) {
    RC_ASSERT(!layers.problems().front().detail.empty());
    return;
  }
  for (const ExrLayer& layer : *layers) {
    const auto& image = layer.image;
    RC_ASSERT(std::get<std::vector<float>>(image.pixels).size() ==
              static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) * image.channels.size());
  }
}

/// One part of an EXR as OpenImageIO sees it.
struct ReadPart {
  OIIO::ImageSpec spec;
  std::map<std::string, std::vector<float>> channels;
};

std::vector<ReadPart> readExr(const Bytes& exr) {
  OiioFile file("openexr", exr);
  std::vector<ReadPart> parts;
  for (int i = 0; file.input && file.input->seek_subimage(i, 0); ++i) {
    ReadPart part{file.input->spec(i), {}};
    const auto channelCount = static_cast<std::size_t>(part.spec.nchannels);
    std::vector<float> pixels(part.spec.image_pixels() * channelCount);
    EXPECT_TRUE(file.input->read_image(i, 0, 0, part.spec.nchannels, OIIO::TypeFloat, pixels.data()));
    for (std::size_t from = 0; from < pixels.size(); ++from) {
      part.channels[part.spec.channelnames[from % channelCount]].push_back(pixels[from]);
    }
    parts.push_back(std::move(part));
  }
  return parts;
}

const std::vector<ExrCompression> kCompressions{ExrCompression::none, ExrCompression::rle, ExrCompression::zip,
                                                ExrCompression::piz};

TEST(EncodeExr, NamesItsLayersAndParts) {
  const Image color = counted(4, 2, {"R", "G", "B"});
  const Image depth = counted(4, 2, {"Z"});
  const Image atlas = counted(3, 5, {"Z"});
  const std::vector<ImageLayer> layers{{"", &color}, {"depth", &depth, true}, {"atlas", &atlas, true}};
  const auto exr = encodeExr(layers, ExrCompression::zip, ExrPixelType::half);
  ASSERT_TRUE(exr) << exr.problems().front().detail;
  const auto parts = readExr(*exr);
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_EQ(parts[0].spec.width, 4);
  EXPECT_EQ(parts[0].spec.height, 2);
  ASSERT_EQ(parts[0].channels.size(), 4u);
  EXPECT_EQ(parts[0].channels.at("R"), (std::vector<float>{0, 1.5f, 3, 4.5f, 6, 7.5f, 9, 10.5f}));
  EXPECT_EQ(parts[0].channels.at("depth.Z"), std::get<std::vector<float>>(depth.pixels));
  EXPECT_EQ(parts[1].spec.width, 3);
  EXPECT_EQ(parts[1].spec.full_width, 4) << "one display window, as EXR demands";
  EXPECT_EQ(parts[1].spec.get_string_attribute("oiio:subimagename"), "atlas");
  EXPECT_EQ(parts[1].channels.at("atlas.Z"), std::get<std::vector<float>>(atlas.pixels));
}

TEST(EncodeExr, WritesAllPixelTypesAndCompressions) {
  const Image color = counted(5, 3, {"R", "G", "B"});
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
      EXPECT_EQ(parts[0].channels.at("G")[1], 2.0f);
    }
  }
}

TEST(EncodeExr, KeepsDepthExactBesideHalfColour) {
  const Image color = counted(1, 1, {"R", "G", "B"});
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
  const Image color = counted(4, 2, {"R", "G", "B"});
  const Image atlas = counted(2, 2, {"Z"});
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
