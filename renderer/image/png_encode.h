#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "protocol/base/result.h"
#include "renderer/image/image.h"

/// PNGs by stripes: runs of rows that are filtered and compressed without looking at each other, so that all cores can
/// work on one picture, and on its finished rows while others are still drawn. The bytes of a file do not depend on the
/// order of its stripes or on the number of threads.
namespace gnomon {

struct PngFormat {
  int width = 1;
  int height = 1;
  int channelCount = 3; ///< 1 grey, 3 RGB, 4 RGB and straight alpha
  int level = 2;        ///< 0 fastest .. 9 smallest
  int bits = 8;         ///< of a channel: 8 or 16

  std::size_t pixelBytes() const { return static_cast<std::size_t>(channelCount * bits / 8); }
  std::size_t rowBytes() const { return static_cast<std::size_t>(width) * pixelBytes(); }
  std::size_t stripeRows() const; ///< of every stripe but the last, which has what is left
  std::size_t stripeCount() const;
};

/// One stripe as it is in the file.
struct PngStripe {
  Bytes chunk;             ///< an IDAT chunk
  std::uint32_t adler = 1; ///< Adler-32 of the filtered rows
  std::size_t filteredBytes = 0;
};

/// `rows`: those of this stripe, interleaved, first row on top; of 16 bits the higher byte first.
PngStripe pngStripe(const PngFormat& format, std::span<const std::uint8_t> rows);

/// The file. REQUIRES: all stripes of the picture, from the top down.
Bytes assemblePng(const PngFormat& format, std::span<const PngStripe> stripes);

/// A PNG of an image of 8 or 16 bits and 1, 3 or 4 channels, by all cores. level 0..9.
Result<Bytes> encodePng(const Image& image, int level);

} // namespace gnomon
