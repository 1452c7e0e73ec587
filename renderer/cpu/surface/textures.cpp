#include "renderer/cpu/surface/textures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <system_error>
#include <utility>

#include "renderer/core/parallel.h"
#include "renderer/core/stop.h"

namespace gnomon::cpu {
namespace {

double linearOf(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

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

/// Which two texels of a row a texel of the next level lies between, and the second one's share.
struct Between {
  int first = 0, second = 0;
  double share = 0;
};

std::vector<Between> betweenTexels(int from, int to) {
  std::vector<Between> all(static_cast<std::size_t>(to));
  for (int i = 0; i < to; ++i) {
    const double place = (i + 0.5) * from / to - 0.5;
    const int first = static_cast<int>(std::floor(place));
    all[static_cast<std::size_t>(i)] = {std::max(first, 0), std::min(first + 1, from - 1), place - first};
  }
  return all;
}

/// The byte of each channel, from the scales of the first three and of the last.
template <class Byte>
std::uint32_t texelOf(const ByteScale& color, const ByteScale& alpha, const Byte& byte) {
  return byte(color, 0) | byte(color, 8) << 8 | byte(color, 16) << 16 | byte(alpha, 24) << 24;
}

/// Rows of a level in which texels are the means of four.
void meanRows(const TextureLevel& from, const ByteScale& color, const ByteScale& alpha, std::size_t first,
              std::size_t last, std::uint32_t* to) {
  const auto width = static_cast<std::size_t>(from.width / 2);
  for (std::size_t y = first; y < last; ++y) {
    const std::uint32_t* upper = from.texels + 4 * y * width;
    const std::uint32_t* lower = upper + 2 * width;
    for (std::size_t x = 0; x < width; ++x) {
      const std::uint32_t a = upper[2 * x], b = upper[2 * x + 1], c = lower[2 * x], d = lower[2 * x + 1];
      to[y * width + x] = texelOf(color, alpha, [&](const ByteScale& scale, unsigned shift) {
        const auto number = [&](std::uint32_t texel) { return scale.number(texel >> shift & 255u); };
        return scale.byteOfFour(number(a) + number(b) + number(c) + number(d));
      });
    }
  }
}

/// The same where a side is odd.
void mixedRows(const TextureLevel& from, const ByteScale& color, const ByteScale& alpha,
               std::span<const Between> across, std::span<const Between> down, std::uint32_t* to) {
  for (const Between& y : down) {
    const std::uint32_t* upper = from.texels + static_cast<std::size_t>(y.first) * static_cast<std::size_t>(from.width);
    const std::uint32_t* lower =
        from.texels + static_cast<std::size_t>(y.second) * static_cast<std::size_t>(from.width);
    for (const Between& x : across) {
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

std::vector<std::uint32_t> halved(const TextureLevel& from, int width, int height, bool srgb, Cores cores) {
  static const ByteScale kLinear(false);
  static const ByteScale kSrgb(true);
  const ByteScale& color = srgb ? kSrgb : kLinear;
  const auto columns = static_cast<std::size_t>(width), rows = static_cast<std::size_t>(height);
  std::vector<std::uint32_t> to(columns * rows);
  if (from.width != 2 * width || from.height != 2 * height) {
    mixedRows(from, color, kLinear, betweenTexels(from.width, width), betweenTexels(from.height, height), to.data());
    return to;
  }
  const auto mean = [&](std::size_t first, std::size_t last) {
    meanRows(from, color, kLinear, first, last, to.data());
  };
  constexpr std::size_t kPieceTexels = 1 << 14;
  if (cores == Cores::one || to.size() <= kPieceTexels) {
    mean(0, rows);
  } else {
    forEachPiece(rows, std::max<std::size_t>(kPieceTexels / columns, 1), mean);
  }
  return to;
}

} // namespace

Pyramid pyramidOf(const Image& image, bool srgb, Cores cores) {
  Pyramid pyramid;
  pyramid.srgb = srgb;
  const auto& pixels = std::get<std::vector<std::uint8_t>>(image.pixels);
  // The first byte is red, in the lowest place: so it is where memory is little-endian, as everywhere that this runs.
  pyramid.levels.push_back({reinterpret_cast<const std::uint32_t*>(pixels.data()), image.width, image.height});
  while (pyramid.levels.back().width > 1 || pyramid.levels.back().height > 1) {
    const TextureLevel& from = pyramid.levels.back();
    const int width = std::max(from.width / 2, 1);
    const int height = std::max(from.height / 2, 1);
    pyramid.owned.push_back(halved(from, width, height, srgb, cores));
    pyramid.levels.push_back({pyramid.owned.back().data(), width, height});
  }
  return pyramid;
}

Textures::Textures(SceneImages images)
    : images_(std::move(images)), made_(std::make_unique<Made[]>(2 * images_.size())) {}

namespace {

std::vector<int> imagesOf(std::span<const TextureImage> textures) {
  std::vector<int> images;
  for (const TextureImage& each : textures) {
    if (images.empty() || images.back() != each.image) images.push_back(each.image);
  }
  return images;
}

} // namespace

std::vector<TextureImage> Textures::missing(std::span<const TextureImage> wanted) const {
  std::vector<TextureImage> missing;
  std::copy_if(wanted.begin(), wanted.end(), std::back_inserter(missing), [this](const TextureImage& each) {
    return madeOf(each.image, each.srgb).ready.load(std::memory_order_acquire) == nullptr;
  });
  return missing;
}

std::future<void> Textures::decodeAhead(std::span<const TextureImage> wanted) const {
  std::vector<int> images = imagesOf(missing(wanted));
  if (images.empty()) return {};
  try {
    return std::async(std::launch::async, [all = images_, images = std::move(images), stop = Stop::current()] {
      const Listening listening(stop);
      (void)untilStopped({}, [&] { return decodeImages(all, images); }); // need() tells what is broken
    });
  } catch (const std::system_error&) { // no thread to be had: need() does it all
    return {};
  }
}

Status Textures::need(std::span<const TextureImage> wanted) const {
  const std::vector<TextureImage> missing = this->missing(wanted);
  if (missing.empty()) return Done{};
  if (Status decoded = decodeImages(images_, imagesOf(missing)); !decoded) return decoded;
  for (const TextureImage& each : missing) make(each.image, each.srgb, Cores::all);
  return Done{};
}

const Pyramid& Textures::make(int image, bool srgb, Cores cores) const {
  Made& made = madeOf(image, srgb);
  const std::lock_guard lock(made.making);
  if (!made.pyramid) {
    made.pyramid =
        std::make_unique<const Pyramid>(pyramidOf(images_[static_cast<std::size_t>(image)]->pixels(), srgb, cores));
    for (const auto& level : made.pyramid->owned) bytes_ += level.size() * sizeof(level[0]);
    made.ready.store(made.pyramid.get(), std::memory_order_release);
  }
  return *made.pyramid;
}

} // namespace gnomon::cpu
