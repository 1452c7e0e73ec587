#include <algorithm>
#include <cstddef>
#include <span>

#include "renderer/core/parallel.h"
#include "renderer/image/picture_encode.h"

namespace gnomon {
namespace {

constexpr int kBits = 16; ///< behind the point

constexpr int fixed(double value) {
  const double scaled = value * (1 << kBits);
  return static_cast<int>(scaled < 0 ? scaled - 0.5 : scaled + 0.5);
}

// ITU-R BT.709, section 3: what red, green and blue count for, where 0..255 becomes 219 steps of Y', 224 of Cb and Cr.
constexpr double kRed = 0.2126, kBlue = 0.0722;
constexpr double kLuma = 219.0 / 255, kChroma = 224.0 / 255;
constexpr int kYR = fixed(kLuma * kRed), kYB = fixed(kLuma * kBlue), kYG = fixed(kLuma) - kYR - kYB;
constexpr int kHalf = fixed(kChroma / 2);
constexpr int kCbR = fixed(-kChroma * kRed / (2 * (1 - kBlue))), kCbG = -kHalf - kCbR;
constexpr int kCrB = fixed(-kChroma * kBlue / (2 * (1 - kRed))), kCrG = -kHalf - kCrB;

struct Rgb {
  int red = 0, green = 0, blue = 0;
};

struct Pixels {
  const std::uint8_t* bytes;
  std::size_t width, height, channels;

  Rgb at(std::size_t x, std::size_t y) const {
    const std::uint8_t* const pixel = bytes + (y * width + x) * channels;
    return channels == 1 ? Rgb{pixel[0], pixel[0], pixel[0]} : Rgb{pixel[0], pixel[1], pixel[2]};
  }
};

std::uint8_t rounded(int value, int offset, int bits) {
  return static_cast<std::uint8_t>(offset + ((value + (1 << (bits - 1))) >> bits));
}

void lumaRow(const Pixels& pixels, std::size_t y, std::uint8_t* row) {
  for (std::size_t x = 0; x < pixels.width; ++x) {
    const Rgb c = pixels.at(x, y);
    row[x] = rounded(kYR * c.red + kYG * c.green + kYB * c.blue, 16, kBits);
  }
}

/// Of the pixel rows 2 y and 2 y + 1; at an odd edge, the last ones count twice.
void chromaRow(const Pixels& pixels, std::size_t y, std::uint8_t* cb, std::uint8_t* cr) {
  const std::size_t ys[] = {2 * y, std::min(2 * y + 1, pixels.height - 1)};
  for (std::size_t x = 0; 2 * x < pixels.width; ++x) {
    const std::size_t xs[] = {2 * x, std::min(2 * x + 1, pixels.width - 1)};
    Rgb sum;
    for (const std::size_t py : ys) {
      for (const std::size_t px : xs) {
        const Rgb c = pixels.at(px, py);
        sum.red += c.red;
        sum.green += c.green;
        sum.blue += c.blue;
      }
    }
    cb[x] = rounded(kCbR * sum.red + kCbG * sum.green + kHalf * sum.blue, 128, kBits + 2);
    cr[x] = rounded(kHalf * sum.red + kCrG * sum.green + kCrB * sum.blue, 128, kBits + 2);
  }
}

} // namespace

Result<Bytes> encodeI420(const Image& image) {
  const auto* bytes = pixelsAs<std::uint8_t>(image);
  if (!bytes || !isPicture(image)) {
    return Problem{ProblemCode::internal, "", "A video needs 8-bit images of 1, 3 or 4 channels."};
  }
  const auto width = static_cast<std::size_t>(image.width), height = static_cast<std::size_t>(image.height);
  const Pixels pixels{bytes->data(), width, height, image.channels.size()};
  const std::size_t halfWidth = (width + 1) / 2, halfHeight = (height + 1) / 2;
  Bytes planes(width * height + 2 * halfWidth * halfHeight);
  std::uint8_t* const cb = planes.data() + width * height;
  std::uint8_t* const cr = cb + halfWidth * halfHeight;
  constexpr std::size_t kRowsAtOnce = 16;
  forEachPiece(halfHeight, kRowsAtOnce, [&](std::size_t first, std::size_t last) {
    for (std::size_t y = first; y < last; ++y) {
      for (std::size_t row = 2 * y; row < std::min(2 * y + 2, height); ++row) {
        lumaRow(pixels, row, planes.data() + row * width);
      }
      chromaRow(pixels, y, cb + y * halfWidth, cr + y * halfWidth);
    }
  });
  return planes;
}

} // namespace gnomon
