#include "clients/cli/compare/picture_difference.h"

#include <gtest/gtest.h>
#include <limits>

namespace gnomon::cli {
namespace {

/// Black and opaque, but for the red of one pixel.
Image blackBut(int width, int height, int pixel, std::uint8_t red) {
  std::vector<std::uint8_t> pixels(static_cast<std::size_t>(width * height) * 4, 0);
  for (std::size_t at = 3; at < pixels.size(); at += 4) pixels[at] = 255;
  pixels[static_cast<std::size_t>(pixel) * 4] = red;
  return {width, height, {"R", "G", "B", "A"}, pixels};
}

void expectRedSecond(const Image& a, const Image& b, double threshold) {
  const auto file = differencePicture(a, b, threshold);
  ASSERT_TRUE(file);
  const auto picture = decodePicture(*file, "diff");
  ASSERT_TRUE(picture);
  EXPECT_EQ(std::get<0>(picture->front().image.pixels), (std::vector<std::uint8_t>{0, 0, 0, 255, 255, 0, 0, 255}));
}

TEST(PictureDifference, EqualPicturesHaveNone) {
  const Image picture = blackBut(3, 2, 4, 51);
  const auto difference = differenceOf(picture, picture, 0);
  ASSERT_TRUE(difference);
  EXPECT_EQ(difference->largest, 0);
  EXPECT_EQ(difference->mean, 0);
  EXPECT_EQ(difference->beyond, 0);
  EXPECT_EQ(difference->pixels, 6);
}

TEST(PictureDifference, IsThatOfTheWorstChannelAndPixel) {
  const auto difference = differenceOf(blackBut(3, 2, 4, 51), blackBut(3, 2, 4, 0), 0.1);
  ASSERT_TRUE(difference);
  EXPECT_DOUBLE_EQ(difference->largest, 0.2);
  EXPECT_DOUBLE_EQ(difference->mean, 0.2 / 6);
  EXPECT_EQ(difference->beyond, 1);
  EXPECT_EQ(difference->worstX, 1);
  EXPECT_EQ(difference->worstY, 1);
}

TEST(PictureDifference, TheThresholdItselfPasses) {
  const auto difference = differenceOf(blackBut(2, 2, 0, 51), blackBut(2, 2, 0, 0), 0.2);
  ASSERT_TRUE(difference);
  EXPECT_EQ(difference->beyond, 0);
}

TEST(PictureDifference, SizesThatDifferAreAProblem) {
  const auto difference = differenceOf(blackBut(3, 2, 0, 0), blackBut(2, 3, 0, 0), 0);
  ASSERT_FALSE(difference);
  EXPECT_EQ(difference.problems().front().limit, "3x2");
  EXPECT_EQ(difference.problems().front().actual, "2x3");
}

TEST(PictureDifference, ItsPictureIsBlackWhereNothingDiffersAndRedBeyondTheThreshold) {
  expectRedSecond(blackBut(2, 1, 1, 200), blackBut(2, 1, 1, 0), 0.5);
}

constexpr float kInfinite = std::numeric_limits<float>::infinity();
constexpr float kNone = std::numeric_limits<float>::quiet_NaN();

Image depths(std::vector<float> pixels) {
  return {static_cast<int>(pixels.size()), 1, {"Z"}, std::move(pixels)};
}

TEST(PictureDifference, FloatsDifferByWhatTheyDiffer) {
  const auto difference = differenceOf(depths({1, 20, kInfinite, kNone}), depths({1.5f, 17, kInfinite, kNone}), 0.5);
  ASSERT_TRUE(difference);
  EXPECT_DOUBLE_EQ(difference->largest, 3);
  EXPECT_EQ(difference->worstX, 1);
  EXPECT_EQ(difference->beyond, 1);
  EXPECT_DOUBLE_EQ(difference->mean, 3.5 / 4);
}

TEST(PictureDifference, ANumberAndNoneDifferWithoutEnd) {
  for (const float other : {kInfinite, -kInfinite, kNone}) {
    const auto difference = differenceOf(depths({1, 1}), depths({1, other}), 1e30);
    ASSERT_TRUE(difference);
    EXPECT_EQ(difference->largest, kInfinite);
    EXPECT_EQ(difference->beyond, 1);
    expectRedSecond(depths({1, 1}), depths({1, other}), 0);
  }
}

TEST(PictureDifference, KindsAndChannelsThatDifferAreAProblem) {
  const auto kind = differenceOf(depths({1, 1}), blackBut(2, 1, 0, 0), 0);
  ASSERT_FALSE(kind);
  EXPECT_EQ(kind.problems().front().limit, "linear floats");
  Image other = depths({1, 1});
  other.channels = {"Y"};
  const auto channels = differenceOf(depths({1, 1}), other, 0);
  ASSERT_FALSE(channels);
  EXPECT_EQ(channels.problems().front().actual, "Y");
}

std::vector<ExrLayer> layersNamed(std::initializer_list<const char*> names) {
  std::vector<ExrLayer> layers;
  for (const char* name : names) layers.push_back({name, depths({1})});
  return layers;
}

TEST(LayerPairs, AreThoseOfOneNameOrThoseAskedFor) {
  const auto a = layersNamed({"color", "depth"}), b = layersNamed({"depth", "color"});
  const auto pairs = layerPairs(a, b, {});
  ASSERT_TRUE(pairs);
  ASSERT_EQ(pairs->size(), 2u);
  EXPECT_EQ((*pairs)[0].second, 1u);
  const std::vector<std::string> crossed{"color=depth"};
  const auto asked = layerPairs(a, b, crossed);
  ASSERT_TRUE(asked);
  ASSERT_EQ(asked->size(), 1u);
  EXPECT_EQ((*asked)[0].second, 0u);
  EXPECT_TRUE(layerPairs(layersNamed({"main"}), layersNamed({"rgb"}), {})); // the only ones
}

TEST(LayerPairs, ALayerThatOneOfThemLacksIsAProblem) {
  const auto both = layersNamed({"color", "depth"}), one = layersNamed({"color"});
  const auto missing = layerPairs(both, one, {});
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.problems().front().limit, "color");
  EXPECT_EQ(missing.problems().front().actual, "depth");
  EXPECT_EQ(missing.problems().front().pointer, ""); // no flag asked for it
  EXPECT_EQ(missing.problems().front().detail, "The second picture has no such layer.");
  EXPECT_EQ(layerPairs(one, both, {}).problems().front().detail, "The first picture has no such layer.");
  const std::vector<std::string> unknown{"dept"};
  EXPECT_EQ(layerPairs(both, both, unknown).problems().front().pointer, "--layer");
  EXPECT_TRUE(layerPairs(layersNamed({"a=b", "c"}), layersNamed({"a=b", "c"}), {})); // a name, not two
}

} // namespace
} // namespace gnomon::cli
