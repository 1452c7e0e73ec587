#include <gtest/gtest.h>

#include "renderer/image/picture_encode.h"

namespace gnomon {
namespace {

Image floats(int width, int height, std::vector<std::string> channels, std::vector<float> pixels) {
  return {width, height, std::move(channels), std::move(pixels)};
}

TEST(ExrLayout, PutsLayersOfOneSizeSideBySide) {
  const Image color = floats(2, 1, {"R", "G", "B"}, {1, 2, 3, 4, 5, 6});
  const Image depth = floats(2, 1, {"Z"}, {7, 8});
  const std::vector<ImageLayer> layers{{"", &color}, {"depth", &depth, true}};
  const auto parts = exrParts(layers, ExrPixelType::half);
  ASSERT_TRUE(parts);
  ASSERT_EQ(parts->size(), 1u);
  const ExrPart& part = parts->front();
  EXPECT_EQ(part.name, "main");
  EXPECT_EQ(part.channels, (std::vector<std::string>{"R", "G", "B", "depth.Z"}));
  EXPECT_EQ(part.half, (std::vector<bool>{true, true, true, false})) << "depth stays float";
  EXPECT_EQ(part.pixels, (std::vector<float>{1, 2, 3, 7, 4, 5, 6, 8}));
}

TEST(ExrLayout, IndicesStayExact) {
  const Image ids = floats(1, 1, {"id"}, {99999});
  const std::vector<ImageLayer> layers{{"casterIds", &ids, true}};
  EXPECT_EQ(exrParts(layers, ExrPixelType::half)->front().half, std::vector<bool>{false});
}

TEST(ExrLayout, GivesAnotherSizeAPartOfItsOwn) {
  const Image color = floats(2, 1, {"R"}, {1, 2});
  const Image atlas = floats(1, 1, {"Z"}, {3});
  const Image mask = floats(2, 1, {"Y"}, {4, 5});
  const std::vector<ImageLayer> layers{{"color", &color}, {"atlas", &atlas}, {"shadow", &mask}};
  const auto parts = exrParts(layers, ExrPixelType::float_);
  ASSERT_TRUE(parts);
  ASSERT_EQ(parts->size(), 2u);
  EXPECT_EQ((*parts)[0].channels, (std::vector<std::string>{"color.R", "shadow.Y"}));
  EXPECT_EQ((*parts)[1].name, "atlas");
  EXPECT_EQ((*parts)[1].channels, (std::vector<std::string>{"atlas.Z"}));
}

TEST(ExrLayout, AssociatesColourWithItsOwnLayersAlphaOnly) {
  const Image color = floats(1, 1, {"R", "G", "B", "A"}, {1, 2, 4, 0.5f});
  const Image other = floats(1, 1, {"R", "G", "B"}, {1, 2, 4});
  const std::vector<ImageLayer> layers{{"color", &color}, {"normal", &other}};
  const auto parts = exrParts(layers, ExrPixelType::float_);
  ASSERT_TRUE(parts);
  EXPECT_EQ(parts->front().pixels, (std::vector<float>{0.5f, 1, 2, 0.5f, 1, 2, 4}));
}

TEST(ExrLayout, RefusesWhatIsNoFloatImageOfItsOwnSize) {
  const Image bytes{1, 1, {"R"}, std::vector<std::uint8_t>{1}};
  const Image shortImage = floats(2, 2, {"R"}, {1, 2, 3});
  const Image empty = floats(0, 0, {"R"}, {});
  for (const Image* image : {&bytes, &shortImage, &empty, static_cast<const Image*>(nullptr)}) {
    const std::vector<ImageLayer> layers{{"x", image}};
    EXPECT_FALSE(exrParts(layers, ExrPixelType::half));
  }
  EXPECT_FALSE(exrParts({}, ExrPixelType::half));
}

TEST(ExrLayout, RefusesNamesThatMeanTwoThings) {
  const Image one = floats(1, 1, {"R"}, {1});
  const Image wide = floats(2, 1, {"R"}, {1, 2});
  const std::vector<ImageLayer> sameChannel{{"a", &one}, {"a", &one}};
  const std::vector<ImageLayer> samePart{{"a", &one}, {"a", &wide}};
  EXPECT_FALSE(exrParts(sameChannel, ExrPixelType::half));
  EXPECT_FALSE(exrParts(samePart, ExrPixelType::half));
}

} // namespace
} // namespace gnomon
