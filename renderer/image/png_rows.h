#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "renderer/image/image_container.h"

struct inflate_state;

/// The rows of a PNG: from compressed bytes to bytes, and from these to pixels.
namespace gnomon {

/// How pixels are stored.
struct PngPixels {
  int bitDepth = 8;
  int colorType = 0;
  std::vector<std::array<std::uint8_t, 4>> palette{};        ///< 256 of them where colorType is 3
  std::optional<std::array<std::uint16_t, 3>> transparent{}; ///< the grey, or color, that is none

  /// Of a pixel.
  std::size_t bits() const {
    constexpr std::array<int, 7> kChannels{1, 0, 3, 1, 2, 0, 4};
    return static_cast<std::size_t>(kChannels[static_cast<std::size_t>(colorType)] * bitDepth);
  }
};

/// Rows, inflated a few at a time, their filters undone.
class InflatedRows {
 public:
  /// `compressed`: one zlib stream in parts, which outlive this.
  explicit InflatedRows(std::span<const EncodedBytes> compressed);
  ~InflatedRows();

  /// What follows are `rows` rows of this many bytes each, whose first has none above it.
  void begin(std::size_t rowBytes, std::size_t pixelBytes, std::size_t rows);
  /// Valid until the next call. Null where there is none; `wrong` says why.
  const std::uint8_t* next();
  const std::string& wrong() const { return wrong_; }

 private:
  /// How many of so many bytes there are; where fewer, `wrong_` says why.
  std::size_t inflate(std::uint8_t* to, std::size_t bytes);

  std::span<const EncodedBytes> parts_;
  std::unique_ptr<inflate_state> state_;
  std::vector<std::uint8_t> rows_;  ///< a filter's number and a row each
  std::vector<std::uint8_t> above_; ///< the last row that was given
  std::size_t rowBytes_ = 0, pixelBytes_ = 1, left_ = 0, at_ = 0, held_ = 0;
  std::string wrong_;
};

/// `rgba`: 4 bytes a pixel.
void expandRow(const PngPixels& pixels, const std::uint8_t* row, std::size_t count, std::uint8_t* rgba);

} // namespace gnomon
