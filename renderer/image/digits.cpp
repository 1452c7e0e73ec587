#include "renderer/image/digits.h"

#include <algorithm>
#include <cassert>
#include <cstddef>

namespace gnomon {
namespace {

constexpr int kDigitWidth = 5;

/// Rows from the top; the leftmost pixel is the highest of five bits.
using Glyph = std::array<std::uint8_t, kDigitHeight>;

constexpr std::array<Glyph, 10> kDigits{{
    {0b01110, 0b10001, 0b10011, 0b10101, 0b11001, 0b10001, 0b01110},
    {0b00100, 0b01100, 0b00100, 0b00100, 0b00100, 0b00100, 0b01110},
    {0b01110, 0b10001, 0b00001, 0b00110, 0b01000, 0b10000, 0b11111},
    {0b11110, 0b00001, 0b00001, 0b01110, 0b00001, 0b00001, 0b11110},
    {0b00010, 0b00110, 0b01010, 0b10010, 0b11111, 0b00010, 0b00010},
    {0b11111, 0b10000, 0b11110, 0b00001, 0b00001, 0b10001, 0b01110},
    {0b00110, 0b01000, 0b10000, 0b11110, 0b10001, 0b10001, 0b01110},
    {0b11111, 0b00001, 0b00010, 0b00100, 0b01000, 0b01000, 0b01000},
    {0b01110, 0b10001, 0b10001, 0b01110, 0b10001, 0b10001, 0b01110},
    {0b01110, 0b10001, 0b10001, 0b01111, 0b00001, 0b00010, 0b01100},
}};

int widthOf(char character) {
  return character == '.' ? 1 : kDigitWidth;
}

bool isInk(char character, int column, int row) {
  if (character == '.') return row == kDigitHeight - 1;
  assert(character >= '0' && character <= '9');
  const std::uint8_t bits = kDigits[static_cast<std::size_t>(character - '0')][static_cast<std::size_t>(row)];
  return ((bits >> (kDigitWidth - 1 - column)) & 1) != 0;
}

void setPixel(Image& picture, std::size_t pixel, const Rgb& color) {
  constexpr int kWordsAByte = 65535 / 255;
  auto* const words = std::get_if<std::vector<std::uint16_t>>(&picture.pixels);
  for (std::size_t c = 0; c < color.size(); ++c) {
    const std::size_t at = pixel * color.size() + c;
    if (words != nullptr) {
      (*words)[at] = static_cast<std::uint16_t>(color[c] * kWordsAByte);
    } else {
      std::get<std::vector<std::uint8_t>>(picture.pixels)[at] = color[c];
    }
  }
}

} // namespace

int digitsWidth(std::string_view text, int scale) {
  int width = 0;
  for (const char character : text) width += widthOf(character) + 1;
  return std::max(0, width - 1) * scale;
}

void fillRect(Image& picture, int x, int y, int width, int height, const Rgb& color) {
  const int right = std::min(picture.width, x + width);
  const int bottom = std::min(picture.height, y + height);
  for (int row = std::max(0, y); row < bottom; ++row) {
    for (int column = std::max(0, x); column < right; ++column) {
      const auto pixel =
          static_cast<std::size_t>(row) * static_cast<std::size_t>(picture.width) + static_cast<std::size_t>(column);
      setPixel(picture, pixel, color);
    }
  }
}

void drawDigits(Image& picture, std::string_view text, const TextPlace& place, const Rgb& color) {
  int x = place.x;
  for (const char character : text) {
    for (int row = 0; row < kDigitHeight; ++row) {
      for (int column = 0; column < widthOf(character); ++column) {
        if (!isInk(character, column, row)) continue;
        fillRect(picture, x + column * place.scale, place.y + row * place.scale, place.scale, place.scale, color);
      }
    }
    x += (widthOf(character) + 1) * place.scale;
  }
}

} // namespace gnomon
