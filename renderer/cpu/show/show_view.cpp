#include "renderer/cpu/show/show_view.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "renderer/core/parallel.h"
#include "renderer/cpu/show/view_squares.h"
#include "renderer/device/view_image.h"

namespace gnomon::cpu {
namespace {

/// Linear numbers 0..1 to sRGB bytes, rounded right: a byte by the number's leading bits, one more from where the next
/// begins. (IEC 61966-2-1.)
class SrgbBytes {
 public:
  SrgbBytes() {
    for (int byte = 0; byte < 255; ++byte) next_[static_cast<std::size_t>(byte)] = linearOf((byte + 0.5) / 255.0);
    next_[255] = 2.0f;
    for (std::uint32_t i = 0; i < first_.size(); ++i) {
      const float least = std::bit_cast<float>(kLeastBits + (i << kDropped));
      first_[i] = static_cast<std::uint8_t>(std::upper_bound(next_.begin(), next_.end(), least) - next_.begin());
    }
  }

  std::uint8_t of(float linear) const {
    if (!(linear > std::bit_cast<float>(kLeastBits))) return 0;
    const std::uint32_t bits = std::bit_cast<std::uint32_t>(std::min(linear, 1.0f));
    const std::uint8_t byte = first_[(bits - kLeastBits) >> kDropped];
    return static_cast<std::uint8_t>(byte + static_cast<int>(linear >= next_[byte]));
  }

 private:
  static constexpr std::uint32_t kLeastBits = 0x39000000u; ///< 2^-13: below, a byte is 0
  static constexpr int kDropped = 16;                      ///< 128 steps an octave, so that none spans two bytes
  static float linearOf(double encoded) {
    return static_cast<float>(encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4));
  }
  std::array<float, 256> next_{}; ///< where each byte ends
  std::array<std::uint8_t, ((0x3f800000u - kLeastBits) >> kDropped) + 1> first_{};
};

std::uint8_t unormByte(float value) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0f, 1.0f) * 255.0f));
}

/// Turns each value of a square's pixels into the picture's.
template <class T, class Convert>
void writeSquare(const TileColors& colors, int x, int y, Image& image, std::vector<T>& pixels, const Convert& convert) {
  const std::size_t channels = image.channels.size();
  for (int row = 0; row < std::min(kTileSide, image.height - y); ++row) {
    const auto line = static_cast<std::size_t>(image.height - 1 - y - row) * static_cast<std::size_t>(image.width);
    T* out = &pixels[(line + static_cast<std::size_t>(x)) * channels];
    for (int column = 0; column < std::min(kTileSide, image.width - x); ++column) {
      const auto pixel = static_cast<std::size_t>((row & 12) << 4 | (column & 12) << 2 | (row & 3) << 2 | (column & 3));
      for (std::size_t c = 0; c < channels; ++c) *out++ = convert(colors.channels[c][pixel], c);
    }
  }
}

/// Calls `each(list, x, y)` with the fragments of every square of the picture.
template <class Each>
void forEachSquare(const ShowJob& job, const Each& each) {
  const auto across = static_cast<std::size_t>((job.scene.width + kTileSide - 1) / kTileSide);
  const auto up = static_cast<std::size_t>((job.scene.height + kTileSide - 1) / kTileSide);
  forEachPiece(across * up, 8, [&](std::size_t first, std::size_t last) {
    FragmentList list;
    for (std::size_t i = first; i < last; ++i) {
      const int x = static_cast<int>(i % across) * kTileSide;
      const int y = static_cast<int>(i / across) * kTileSide;
      listFragments(job.buffer, x, y, list);
      each(list, x, y);
    }
  });
}

template <class T, class Convert>
void fill(const ShowJob& job, Image& image, const Convert& convert) {
  const bool picture = traitsOf(job.view).source == ViewSource::picture;
  std::vector<T> pixels(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) *
                        image.channels.size());
  forEachSquare(job, [&](const FragmentList& list, int x, int y) {
    TileColors colors;
    picture ? pictureSquare(job, list, x, y, colors) : dataSquare(job, list, x, y, colors);
    writeSquare(colors, x, y, image, pixels, convert);
  });
  image.pixels = std::move(pixels);
}

} // namespace

Image showView(const ShowJob& job, bool opaque) {
  static const SrgbBytes srgb;
  Image image{job.scene.width, job.scene.height, channelsOf(job.view, job.encoded, opaque), {}};
  if (!job.encoded) {
    fill<float>(job, image, [](float value, std::size_t) { return value; });
  } else if (traitsOf(job.view).source == ViewSource::picture) {
    fill<std::uint8_t>(job, image,
                       [](float value, std::size_t c) { return c < 3 ? srgb.of(value) : unormByte(value); });
  } else {
    fill<std::uint8_t>(job, image, [](float value, std::size_t) { return unormByte(value); });
  }
  return image;
}

} // namespace gnomon::cpu
