#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "protocol/base/bytes.h"

namespace gnomon {

/// Pixels, interleaved, first row on top. 8 bits: 0..255, 16 bits: 0..65535, sRGB where it is a colour; float: linear.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<std::string> channels; ///< in order, e.g. {"R","G","B","A"}, {"Z"}
  std::variant<std::vector<std::uint8_t>, std::vector<float>, std::vector<std::uint16_t>> pixels;
};

/// The pixels of an image of these numbers; null where it is of others, or has not as many as its size says.
template <class Number>
const std::vector<Number>* pixelsAs(const Image& image) {
  const auto* numbers = std::get_if<std::vector<Number>>(&image.pixels);
  if (!numbers || image.width <= 0 || image.height <= 0 || numbers->empty()) return nullptr;
  const std::size_t pixels = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  return numbers->size() == pixels * image.channels.size() ? numbers : nullptr;
}

/// Grey, RGB or RGBA.
inline bool isPicture(const Image& image) {
  const std::size_t channels = image.channels.size();
  return channels == 1 || channels == 3 || channels == 4;
}

} // namespace gnomon
