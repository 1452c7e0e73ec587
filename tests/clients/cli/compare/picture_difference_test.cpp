#include "clients/cli/compare/picture_difference.h"

#include <gtest/gtest.h>

namespace gnomon::cli {
namespace {

/// Black and opaque, but for the red of one pixel.
Image blackBut(int width, int height, int pixel, std::uint8_t red) {
  std::vector<std::uint8_t> pixels(static_cast<std::size_t>(width * height) * 4, 0);
  for (std::size_t at = 3; at < pixels.size(); at += 4) pixels[at] = 255;
  pixels[static_cast<std::size_t>(pixel) * 4] = red;
  return {width, height, {"R", "G", "B", "A"}, pixels};
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
  const auto file = differencePicture(blackBut(2, 1, 1, 200), blackBut(2, 1, 1, 0), 0.5);
  ASSERT_TRUE(file);
  const auto picture = decodePicture(*file, "diff");
  ASSERT_TRUE(picture);
  EXPECT_EQ(std::get<0>(picture->pixels), (std::vector<std::uint8_t>{0, 0, 0, 255, 255, 0, 0, 255}));
}

} // namespace
} // namespace gnomon::cli
