#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>

#include "renderer/core/vectors.h"
#include "renderer/image/image_codec.h"
#include "renderer/image/image_container.h"

namespace gnomon {

/// Where a decoder puts the rows of a picture, 8-bit RGBA, first row on top: all in one place, or some at a time,
/// handed on as soon as they are complete.
class DecodedRows {
 public:
  static constexpr int kStep = 16; ///< decoders work on so many rows before they ask whether to stop

  /// Into `rgba`, width * height * 4 bytes.
  DecodedRows(const ImageSize& size, std::uint8_t* rgba);
  /// `atOnce`, a multiple of kStep, at a time; all at once of a file that does not hold them in order.
  DecodedRows(const ImageSize& size, int atOnce, const TakeRows& take);

  const ImageSize& size() const { return size_; }
  std::size_t rowBytes() const { return 4 * static_cast<std::size_t>(size_.width); }

  /// Where row `y` goes. REQUIRES: all rows before the kStep rows it is one of are complete.
  std::uint8_t* at(int y) { return rgba_ + rowBytes() * static_cast<std::size_t>(y - first_); }
  /// The same, where rows are filled in any order. REQUIRES: none is complete.
  std::uint8_t* all();
  /// All rows before `end` are filled.
  void complete(int end);

 private:
  void holdRows(int rows);

  ImageSize size_;
  TakeRows take_;                       ///< none where all go in one place
  UnfilledVector<std::uint8_t> buffer_; ///< of rows that are handed on
  std::uint8_t* rgba_ = nullptr;        ///< row `first_`
  int first_ = 0;
  int held_ = 0; ///< rows that there is room for
};

// Each fills `to` from what essentialPng() and the like give, without color conversion, and returns what is wrong with
// the data; empty = nothing.

/// Why the bytes hold no picture at all; empty = they do.
std::string unreadablePng(EncodedBytes essential);

/// 16 bits are rounded to 8; what can't be read is 0. REQUIRES: unreadablePng() is empty.
std::string decodePng(EncodedBytes essential, DecodedRows& to);

/// Alpha is 255. What can't be read is grey.
std::string decodeJpeg(EncodedBytes essential, DecodedRows& to);

/// Straight alpha; where the picture has none, 255.
std::string decodeWebp(EncodedBytes essential, DecodedRows& to);

} // namespace gnomon
