#include "renderer/frame/view_words.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace gnomon {
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
