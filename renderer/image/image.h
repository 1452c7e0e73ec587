#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "protocol/base/bytes.h"

namespace gnomon {

/// Pixels, interleaved, first row on top. 8 bits: 0..255, 16 bits: 0..65535, sRGB where it is a color; float: linear.
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

/// Whether its last channel is A.
inline bool hasAlpha(const Image& image) {
  return image.channels.size() > 1 && image.channels.back() == "A";
}

/// The floats of an image that has alpha, all other channels multiplied by it.
inline std::vector<float> associated(const Image& image) {
  std::vector<float> pixels = std::get<std::vector<float>>(image.pixels);
  const std::size_t channels = image.channels.size();
  for (std::size_t pixel = 0; pixel < pixels.size(); pixel += channels) {
    for (std::size_t c = 0; c + 1 < channels; ++c) pixels[pixel + c] *= pixels[pixel + channels - 1];
  }
  return pixels;
}

/// Which two texels of a side one of the next smaller level lies between, and the second one's share.
struct BetweenTexels {
  std::size_t first = 0, second = 0;
  double share = 0;
};

/// For each of `to` texels that a side of `from` becomes. REQUIRES: 1 <= to <= from.
inline std::vector<BetweenTexels> betweenTexels(int from, int to) {
  std::vector<BetweenTexels> all(static_cast<std::size_t>(to));
  for (std::size_t i = 0; i < all.size(); ++i) {
    const double place = (static_cast<double>(i) + 0.5) * from / to - 0.5;
    const auto first = static_cast<std::size_t>(std::floor(place));
    all[i] = {first, std::min(first + 1, static_cast<std::size_t>(from) - 1), place - std::floor(place)};
  }
  return all;
}

} // namespace gnomon
