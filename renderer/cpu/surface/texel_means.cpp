#include "renderer/cpu/surface/texel_means.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "renderer/core/srgb.h"
#include "renderer/image/image.h"

namespace gnomon::cpu {
namespace {

/// Bytes of a channel as numbers that can be averaged: 0 to 2^24; and back to the byte whose number is nearest by what
/// it encodes.
class ByteScale {
 public:
  explicit ByteScale(bool srgb) {
    const auto number = [&](double byte) { return (srgb ? linearOf(byte / 255.0) : byte / 255.0) * 0x1p24; };
    for (std::size_t byte = 0; byte < 256; ++byte) {
      numbers_[byte] = static_cast<std::uint32_t>(std::lround(number(static_cast<double>(byte))));
      // Four rounded numbers may fall short by two where their mean is just between two bytes, which counts as the
      // next.
      ends_[byte] = static_cast<std::uint32_t>(std::lround(4.0 * number(static_cast<double>(byte) + 0.5))) - 2u;
    }
    std::uint8_t byte = 0;
    for (std::uint32_t i = 0; i < guesses_.size(); ++i) {
      while (i << kGuessBits >= ends_[byte]) ++byte;
      guesses_[i] = byte;
    }
  }

  std::uint32_t number(std::uint32_t byte) const { return numbers_[byte]; }

  std::uint32_t byteOfFour(std::uint32_t sum) const {
    const std::uint32_t guess = guesses_[sum >> kGuessBits];
    return guess + (sum >= ends_[guess] ? 1 : 0);
  }

 private:
  static constexpr unsigned kGuessBits = 12; ///< so few that no two bytes end within one guess
  std::array<std::uint32_t, 256> numbers_{};
  std::array<std::uint32_t, 256> ends_{}; ///< four numbers that add up to this or more are nearer to the next byte
  std::array<std::uint8_t, (std::size_t{1} << (26 - kGuessBits)) + 1> guesses_{}; ///< the sum's byte, or the one before
};

const ByteScale& scaleOf(bool srgb) {
  static const ByteScale kLinear(false);
  static const ByteScale kSrgb(true);
  return srgb ? kSrgb : kLinear;
}

/// The mean of four bytes, a half rounded up, for each of two channels that lie 16 bits apart.
inline std::uint32_t meanOfPairs(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  constexpr std::uint32_t kPair = 0x00ff00ffu;
  return ((a & kPair) + (b & kPair) + (c & kPair) + (d & kPair) + 0x00020002u) >> 2 & kPair;
}

/// Where both sides of the larger level are even.
void meanTexels(const TextureLevel& from, bool srgb, std::uint32_t* to) {
  const auto width = static_cast<std::size_t>(from.width / 2);
  const auto height = static_cast<std::size_t>(from.height / 2);
  const ByteScale& color = scaleOf(true);
  for (std::size_t y = 0; y < height; ++y) {
    const std::uint32_t* upper = from.texels + 4 * y * width;
    const std::uint32_t* lower = upper + 2 * width;
    std::uint32_t* row = to + y * width;
    for (std::size_t x = 0; x < width; ++x) {
      const std::uint32_t a = upper[2 * x], b = upper[2 * x + 1], c = lower[2 * x], d = lower[2 * x + 1];
      row[x] = meanOfPairs(a, b, c, d) | meanOfPairs(a >> 8, b >> 8, c >> 8, d >> 8) << 8;
    }
    if (!srgb) continue;
    for (std::size_t x = 0; x < width; ++x) {
      const std::uint32_t a = upper[2 * x], b = upper[2 * x + 1], c = lower[2 * x], d = lower[2 * x + 1];
      const auto mean = [&](unsigned shift) {
        const auto number = [&](std::uint32_t texel) { return color.number(texel >> shift & 255u); };
        return color.byteOfFour(number(a) + number(b) + number(c) + number(d)) << shift;
      };
      row[x] = (row[x] & 0xff000000u) | mean(0) | mean(8) | mean(16);
    }
  }
}

/// The byte of each channel, from the scales of the first three and of the last.
template <class Byte>
std::uint32_t texelOf(const ByteScale& color, const ByteScale& alpha, const Byte& byte) {
  return byte(color, 0) | byte(color, 8) << 8 | byte(color, 16) << 16 | byte(alpha, 24) << 24;
}

/// Where a side of the larger level is odd.
void mixedTexels(const TextureLevel& from, bool srgb, std::span<const BetweenTexels> across,
                 std::span<const BetweenTexels> down, std::uint32_t* to) {
  const ByteScale& color = scaleOf(srgb);
  const ByteScale& alpha = scaleOf(false);
  for (const BetweenTexels& y : down) {
    const std::uint32_t* upper = from.texels + y.first * static_cast<std::size_t>(from.width);
    const std::uint32_t* lower = from.texels + y.second * static_cast<std::size_t>(from.width);
    for (const BetweenTexels& x : across) {
      const std::uint32_t a = upper[x.first], b = upper[x.second], c = lower[x.first], d = lower[x.second];
      *to++ = texelOf(color, alpha, [&](const ByteScale& scale, unsigned shift) {
        const auto number = [&](std::uint32_t texel) { return scale.number(texel >> shift & 255u); };
        const double above = number(a) * (1.0 - x.share) + number(b) * x.share;
        const double below = number(c) * (1.0 - x.share) + number(d) * x.share;
        return scale.byteOfFour(static_cast<std::uint32_t>(4.0 * (above * (1.0 - y.share) + below * y.share)));
      });
    }
  }
}

} // namespace

void halve(const TextureLevel& from, const TextureLevel& size, bool srgb, std::uint32_t* to) {
  if (from.width == 2 * size.width && from.height == 2 * size.height) {
    meanTexels(from, srgb, to);
  } else {
    mixedTexels(from, srgb, betweenTexels(from.width, size.width), betweenTexels(from.height, size.height), to);
  }
}

} // namespace gnomon::cpu
