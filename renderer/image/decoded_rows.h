#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>

#include "renderer/core/vectors.h"
#include "renderer/image/image_codec.h"

namespace gnomon {

/// Where a decoder puts the rows of a picture, 8-bit RGBA, first row on top: all of them in one place, or some at a
/// time, which are handed on as soon as they are complete, so that a large picture that is only wanted small never is
/// in memory.
class DecodedRows {
 public:
  static constexpr int kStep = 16; ///< decoders work on so many rows before they ask whether to stop

  /// Into `rgba`, width * height * 4 bytes.
  DecodedRows(const ImageSize& size, std::uint8_t* rgba);
  /// `atOnce`, a multiple of kStep, at a time; at the end, fewer. All at once of a file that does not hold them in
  /// order.
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

} // namespace gnomon
