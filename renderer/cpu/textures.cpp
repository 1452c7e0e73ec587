#include "renderer/cpu/textures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <utility>

namespace gnomon::cpu {
namespace {

double linearOf(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

/// Bytes of a channel as numbers, and back to the nearest byte.
class ByteScale {
 public:
  explicit ByteScale(bool srgb) {
    const auto number = [&](double byte) { return static_cast<float>(srgb ? linearOf(byte / 255.0) : byte / 255.0); };
    for (std::size_t byte = 0; byte < 256; ++byte) numbers_[byte] = number(static_cast<double>(byte));
    // Rounding happens where it is encoded.
    for (std::size_t byte = 0; byte < 255; ++byte) ends_[byte] = number(static_cast<double>(byte) + 0.5);
    ends_[255] = 2.0f;
    std::uint8_t byte = 0;
    for (std::size_t i = 0; i < guesses_.size(); ++i) {
      const float root = static_cast<float>(i) / static_cast<float>(guesses_.size() - 1);
      while (root * root >= ends_[byte]) ++byte;
      guesses_[i] = byte;
    }
  }

  float number(std::uint32_t byte) const { return numbers_[byte]; }

  /// `number`: 0..1.
  std::uint32_t byte(float number) const {
    std::uint32_t byte = guesses_[static_cast<std::size_t>(std::sqrt(number) * (kGuesses - 1))];
    while (number >= ends_[byte]) ++byte;
    return byte;
  }

 private:
  static constexpr int kGuesses = 1024;
  std::array<float, 256> numbers_{};
  std::array<float, 256> ends_{};                ///< numbers from here on are nearer to the next byte
  std::array<std::uint8_t, kGuesses> guesses_{}; ///< by the number's square root: its byte or a lower one
};

/// Which two texels of a row a texel of the next level lies between, and the second one's share.
struct Between {
  int first = 0, second = 0;
  float share = 0;
};

std::vector<Between> betweenTexels(int from, int to) {
  std::vector<Between> all(static_cast<std::size_t>(to));
  for (int i = 0; i < to; ++i) {
    const float place = (static_cast<float>(i) + 0.5f) * static_cast<float>(from) / static_cast<float>(to) - 0.5f;
    const int first = static_cast<int>(std::floor(place));
    all[static_cast<std::size_t>(i)] = {std::max(first, 0), std::min(first + 1, from - 1),
                                        place - static_cast<float>(first)};
  }
  return all;
}

std::vector<std::uint32_t> halved(const TextureLevel& from, int width, int height, bool srgb) {
  static const ByteScale kLinear(false);
  static const ByteScale kSrgb(true);
  const std::array<const ByteScale*, 4> scales{srgb ? &kSrgb : &kLinear, srgb ? &kSrgb : &kLinear,
                                               srgb ? &kSrgb : &kLinear, &kLinear};
  const std::vector<Between> across = betweenTexels(from.width, width);
  const std::vector<Between> down = betweenTexels(from.height, height);
  std::vector<std::uint32_t> to;
  to.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (const Between& y : down) {
    const std::uint32_t* upper = from.texels + static_cast<std::size_t>(y.first) * static_cast<std::size_t>(from.width);
    const std::uint32_t* lower =
        from.texels + static_cast<std::size_t>(y.second) * static_cast<std::size_t>(from.width);
    for (const Between& x : across) {
      std::uint32_t texel = 0;
      for (unsigned channel = 0; channel < 4; ++channel) {
        const ByteScale& scale = *scales[channel];
        const auto number = [&](std::uint32_t from4) { return scale.number(from4 >> (8 * channel) & 255u); };
        const auto row = [&](const std::uint32_t* texels) {
          return number(texels[x.first]) * (1.0f - x.share) + number(texels[x.second]) * x.share;
        };
        const float mean = row(upper) * (1.0f - y.share) + row(lower) * y.share;
        texel |= scale.byte(std::clamp(mean, 0.0f, 1.0f)) << (8 * channel);
      }
      to.push_back(texel);
    }
  }
  return to;
}

} // namespace

Pyramid pyramidOf(const Image& image, bool srgb) {
  Pyramid pyramid;
  pyramid.srgb = srgb;
  const auto& pixels = std::get<std::vector<std::uint8_t>>(image.pixels);
  // The first byte is red, in the lowest place: so it is where memory is little-endian, as everywhere that this runs.
  pyramid.levels.push_back({reinterpret_cast<const std::uint32_t*>(pixels.data()), image.width, image.height});
  while (pyramid.levels.back().width > 1 || pyramid.levels.back().height > 1) {
    const TextureLevel& from = pyramid.levels.back();
    const int width = std::max(from.width / 2, 1);
    const int height = std::max(from.height / 2, 1);
    pyramid.owned.push_back(halved(from, width, height, srgb));
    pyramid.levels.push_back({pyramid.owned.back().data(), width, height});
  }
  return pyramid;
}

Textures::Textures(std::vector<std::shared_ptr<const Image>> images)
    : images_(std::move(images)), made_(std::make_unique<Made[]>(2 * images_.size())) {}

const Pyramid& Textures::make(int image, bool srgb) const {
  Made& made = made_[2 * static_cast<std::size_t>(image) + (srgb ? 1 : 0)];
  const std::lock_guard lock(made.making);
  if (!made.pyramid) {
    made.pyramid = std::make_unique<const Pyramid>(pyramidOf(*images_[static_cast<std::size_t>(image)], srgb));
    for (const auto& level : made.pyramid->owned) bytes_ += level.size() * sizeof(level[0]);
    made.ready.store(made.pyramid.get(), std::memory_order_release);
  }
  return *made.pyramid;
}

} // namespace gnomon::cpu
