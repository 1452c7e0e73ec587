#include "renderer/image/digits.h"

#include <gtest/gtest.h>
#include <set>

namespace gnomon {
namespace {

Image black(int width, int height) {
  const auto bytes = static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 3;
  return {width, height, {"R", "G", "B"}, std::vector<std::uint8_t>(bytes)};
}

/// '#' where the picture is not black.
std::string drawn(const Image& picture) {
  const auto& bytes = std::get<std::vector<std::uint8_t>>(picture.pixels);
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    text += bytes[i] != 0 ? '#' : ' ';
    if ((i / 3 + 1) % static_cast<std::size_t>(picture.width) == 0) text += '\n';
  }
  return text;
}

TEST(Digits, M15_ANameCanBeRead) {
  Image picture = black(13, 7);
  drawDigits(picture, "2.7", {0, 0, 1}, {255, 255, 255});
  EXPECT_EQ(drawn(picture),
            " ###    #####\n"
            "#   #       #\n"
            "    #      # \n"
            "  ##      #  \n"
            " #       #   \n"
            "#        #   \n"
            "##### #  #   \n");
  EXPECT_EQ(digitsWidth("2.7", 1), 13);
}

TEST(Digits, EveryDigitLooksDifferent) {
  std::set<std::string> shapes;
  for (char digit = '0'; digit <= '9'; ++digit) {
    Image picture = black(5, 7);
    drawDigits(picture, std::string(1, digit), {0, 0, 1}, {255, 255, 255});
    shapes.insert(drawn(picture));
  }
  EXPECT_EQ(shapes.size(), 10u);
}

TEST(Digits, AScaleMakesEachPixelASquare) {
  Image small = black(5, 7);
  Image large = black(15, 21);
  drawDigits(small, "4", {0, 0, 1}, {255, 255, 255});
  drawDigits(large, "4", {0, 0, 3}, {255, 255, 255});
  const std::string from = drawn(small);
  const std::string to = drawn(large);
  for (std::size_t y = 0; y < 21; ++y) {
    for (std::size_t x = 0; x < 15; ++x) EXPECT_EQ(to[y * 16 + x], from[(y / 3) * 6 + x / 3]);
  }
}

TEST(Digits, WhatLiesOutsideIsLeftOut) {
  Image picture = black(4, 4);
  drawDigits(picture, "888", {-3, -2, 2}, {255, 0, 0});
  fillRect(picture, 3, 3, 100, 100, {9, 9, 9});
  EXPECT_EQ(std::get<std::vector<std::uint8_t>>(picture.pixels).size(), 4u * 4 * 3);
  EXPECT_EQ(std::get<std::vector<std::uint8_t>>(picture.pixels).back(), 9);
}

} // namespace
} // namespace gnomon
