#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "renderer/image/image.h"

namespace gnomon {

/// 8-bit sRGB.
using Rgb = std::array<std::uint8_t, 3>;

/// Where to write, pixels from the picture's upper left corner, and how large: a digit is 5 x 7 of `scale` pixels.
struct TextPlace {
  int x = 0;
  int y = 0;
  int scale = 1;
};

/// Width of a text in pixels, its last digit's gap left out.
int digitsWidth(std::string_view text, int scale);
inline constexpr int kDigitHeight = 7; ///< times the scale: pixels

/// Writes digits and dots into an RGB picture of 8 or 16 bits, clipped to it. REQUIRES: nothing else in `text`.
void drawDigits(Image& picture, std::string_view text, const TextPlace& place, const Rgb& color);

/// Fills a rectangle, cut to the picture.
void fillRect(Image& picture, int x, int y, int width, int height, const Rgb& color);

} // namespace gnomon
