#include "renderer/image/exr_decode.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <rapidcheck/gtest.h>

#include "renderer/image/image_codec.h"

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
  std::vector<unsigned char> file;
  OIIO::Filesystem::IOVecOutput memory(file);
  const auto output = OIIO::ImageOutput::create("openexr");
  EXPECT_TRUE(output && output->set_ioproxy(&memory) && output->open("exr", spec)) << OIIO::geterror();
  const Image picture = counted(5, 3, {"A", "R"});
  EXPECT_TRUE(output->write_image(OIIO::TypeFloat, std::get<std::vector<float>>(picture.pixels).data()));
  output->close();
  return {file.begin(), file.end()};
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

} // namespace
} // namespace gnomon
