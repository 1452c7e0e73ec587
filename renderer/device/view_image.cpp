#include "renderer/device/view_image.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace gnomon {

std::vector<std::string> channelsOf(View view, bool encoded, bool opaque) {
  const ViewTraits& traits = traitsOf(view);
  std::vector<std::string> channels;
  for (const std::string_view name : encoded ? traits.png : traits.exr) {
    if (!name.empty()) channels.emplace_back(name);
  }
  if (traits.source == ViewSource::picture && !opaque) channels.emplace_back("A");
  return channels;
}

Image depthImage(int width, int height, const std::vector<float>& depths, bool encoded, bool fine) {
  Image image{width, height, {encoded ? "Y" : "Z"}, {}};
  const auto across = static_cast<std::size_t>(width);
  const auto rows = static_cast<std::size_t>(height);
  std::vector<float> turned(depths.size());
  for (std::size_t y = 0; y < rows; ++y) {
    std::copy_n(depths.data() + (rows - 1 - y) * across, across, turned.data() + y * across);
  }
  if (!encoded) {
    image.pixels = std::move(turned);
    return image;
  }
  const auto grey = [&]<class Number>(Number) {
    std::vector<Number> numbers(turned.size());
    std::transform(turned.begin(), turned.end(), numbers.begin(), unorm<Number>);
    image.pixels = std::move(numbers);
  };
  fine ? grey(std::uint16_t()) : grey(std::uint8_t());
  return image;
}

namespace {

constexpr std::uint16_t kNothing = 65535;

std::uint16_t wordOf(float number) {
  return number >= 0 && number < kNothing ? static_cast<std::uint16_t>(std::lround(number)) : kNothing;
}

} // namespace

Image wordsOf(const Image& numbers, View view) {
  constexpr float kMillimetres = 1000; ///< in a metre
  const float scale = view == View::depth ? kMillimetres : 1.0f;
  const auto& from = std::get<std::vector<float>>(numbers.pixels);
  std::vector<std::uint16_t> words(from.size());
  std::transform(from.begin(), from.end(), words.begin(), [&](float number) { return wordOf(number * scale); });
  return {numbers.width, numbers.height, {"Y"}, std::move(words)};
}

} // namespace gnomon
