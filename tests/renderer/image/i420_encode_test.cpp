#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "renderer/image/picture_encode.h"

namespace gnomon {
namespace {

Image filled(int width, int height, std::vector<std::uint8_t> pixel) {
  Image image{width, height, {}, {}};
  for (std::size_t i = 0; i < pixel.size(); ++i) image.channels.emplace_back(1, "RGBA"[i]);
  std::vector<std::uint8_t> pixels;
  for (int i = 0; i < width * height; ++i) pixels.insert(pixels.end(), pixel.begin(), pixel.end());
  image.pixels = std::move(pixels);
  return image;
}

using Color = std::array<int, 3>;

/// Y', Cb and Cr as ITU-R BT.709, section 3, defines them, not rounded.
std::array<double, 3> ycbcr(const Color& color) {
  const double r = color[0] / 255.0, g = color[1] / 255.0, b = color[2] / 255.0;
  const double y = 0.2126 * r + 0.7152 * g + 0.0722 * b;
  return {16 + 219 * y, 128 + 224 * (b - y) / 1.8556, 128 + 224 * (r - y) / 1.5748};
}

TEST(I420, KnownColors) {
  const auto planes = [](std::vector<std::uint8_t> pixel) { return *encodeI420(filled(2, 2, std::move(pixel))); };
  EXPECT_EQ(planes({0, 0, 0}), (Bytes{16, 16, 16, 16, 128, 128}));
  EXPECT_EQ(planes({255, 255, 255}), (Bytes{235, 235, 235, 235, 128, 128}));
  EXPECT_EQ(planes({255, 0, 0}), (Bytes{63, 63, 63, 63, 102, 240}));
  EXPECT_EQ(planes({0, 255, 0}), (Bytes{173, 173, 173, 173, 42, 26}));
  EXPECT_EQ(planes({0, 0, 255}), (Bytes{32, 32, 32, 32, 240, 118}));
  EXPECT_EQ(planes({0, 0, 255, 0}), planes({0, 0, 255})) << "alpha is left out";
}

TEST(I420, GreyHasNoColor) {
  for (int grey = 0; grey < 256; ++grey) {
    const auto byte = static_cast<std::uint8_t>(grey);
    const Bytes planes = *encodeI420(filled(1, 1, {byte, byte, byte}));
    EXPECT_EQ(planes[1], 128) << grey;
    EXPECT_EQ(planes[2], 128) << grey;
    EXPECT_EQ(*encodeI420(filled(1, 1, {byte})), planes);
  }
}

RC_GTEST_PROP(I420, EveryPlaneIsTheDefinitionRounded, ()) {
  Color color;
  for (int& channel : color) channel = *rc::gen::inRange(0, 256);
  std::vector<std::uint8_t> pixel(color.begin(), color.end());
  const Bytes planes = *encodeI420(filled(1, 1, pixel));
  const auto exact = ycbcr(color);
  for (std::size_t i = 0; i < 3; ++i) RC_ASSERT(std::abs(planes[i] - exact[i]) <= 0.51);
}

RC_GTEST_PROP(I420, ColorsAreMeansOfFourAndEdgesCountTwice, ()) {
  const int width = *rc::gen::inRange(1, 40);
  const int height = *rc::gen::inRange(1, 40);
  Image image = filled(width, height, {0, 0, 0});
  auto& pixels = std::get<std::vector<std::uint8_t>>(image.pixels);
  pixels = *rc::gen::container<std::vector<std::uint8_t>>(pixels.size(), rc::gen::arbitrary<std::uint8_t>());
  const Bytes planes = *encodeI420(image);
  const int halfWidth = (width + 1) / 2, halfHeight = (height + 1) / 2;
  RC_ASSERT(planes.size() == static_cast<std::size_t>(width * height + 2 * halfWidth * halfHeight));
  const auto at = [&](int x, int y) {
    const auto i = static_cast<std::size_t>(std::min(y, height - 1) * width + std::min(x, width - 1)) * 3;
    return ycbcr({pixels[i], pixels[i + 1], pixels[i + 2]});
  };
  const int x = *rc::gen::inRange(0, halfWidth), y = *rc::gen::inRange(0, halfHeight);
  for (std::size_t plane : {1, 2}) {
    const double mean = (at(2 * x, 2 * y)[plane] + at(2 * x + 1, 2 * y)[plane] + at(2 * x, 2 * y + 1)[plane] +
                         at(2 * x + 1, 2 * y + 1)[plane]) /
                        4;
    const int found = planes[static_cast<std::size_t>(width * height) +
                             (plane - 1) * static_cast<std::size_t>(halfWidth * halfHeight) +
                             static_cast<std::size_t>(y * halfWidth + x)];
    RC_ASSERT(std::abs(found - mean) <= 0.51);
  }
  RC_ASSERT(std::abs(planes[static_cast<std::size_t>(2 * y * width + 2 * x)] - at(2 * x, 2 * y)[0]) <= 0.51);
}

TEST(I420, WhatIsNotEightBitsIsRefused) {
  EXPECT_FALSE(encodeI420(Image{1, 1, {"R", "G", "B"}, std::vector<float>(3)}));
  EXPECT_FALSE(encodeI420(filled(1, 1, {1, 2})));
  EXPECT_FALSE(encodeI420(Image{2, 2, {"R"}, std::vector<std::uint8_t>(3)}));
  EXPECT_FALSE(encodeI420(Image{0, 0, {"R"}, std::vector<std::uint8_t>()}));
}

} // namespace
} // namespace gnomon
