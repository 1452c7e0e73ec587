#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "renderer/image/image.h"

namespace gnomon {

/// The alpha of a picture, a byte a texel, for readers of a few texels here and there: squares of 8 x 8 lie together.
class AlphaPlane {
 public:
  explicit AlphaPlane(const Image& image); ///< REQUIRES: 8-bit RGBA

  int width() const { return width_; } ///< texels
  int height() const { return height_; }
  /// REQUIRES: a texel of the picture.
  std::uint8_t at(std::size_t column, std::size_t row) const {
    return texels_[(row / kSide * squaresAcross_ + column / kSide) * kSide * kSide + row % kSide * kSide +
                   column % kSide];
  }
  std::size_t bytes() const { return texels_.size(); }

 private:
  static constexpr std::size_t kSide = 8;

  int width_, height_;
  std::size_t squaresAcross_;
  std::vector<std::uint8_t> texels_; ///< of whole squares
};

} // namespace gnomon
