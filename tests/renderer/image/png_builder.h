#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "renderer/image/image.h"

namespace gnomon {

/// A PNG to the letter of its header, sound or not, without a compressor: the rows are stored.
struct PngBuilder {
  std::uint32_t width = 1;
  std::uint32_t height = 1;
  std::uint8_t bitDepth = 8;
  std::uint8_t colorType = 0;                                ///< 0 grey, 2 RGB, 3 palette, 4 grey + alpha, 6 RGBA
  std::vector<std::pair<std::string, Bytes>> beforePixels{}; ///< e.g. {"PLTE", ...}
  std::vector<Bytes> rows{};                                 ///< packed samples, without the filter byte

  Bytes build() const;
};

/// Length, type, data and checksum.
Bytes pngChunk(const std::string& type, const Bytes& data);

} // namespace gnomon
