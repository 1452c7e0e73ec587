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

  /// Of half the size, rounded down but to no less than 1: means of four texels, or mixed from the two around them
  /// along a side that is odd. So textures are made smaller when they are drawn.
  AlphaPlane halved() const;

  int width() const { return width_; } ///< texels
  int height() const { return height_; }
  /// REQUIRES: a texel of the picture.
  std::uint8_t at(std::size_t column, std::size_t row) const { return texels_[placeOf(column, row)]; }
  std::size_t bytes() const { return texels_.size(); }

 private:
  static constexpr std::size_t kSide = 8;

  AlphaPlane(int width, int height);

  static std::size_t squaresOf(int texels) { return (static_cast<std::size_t>(texels) + kSide - 1) / kSide; }
  std::size_t placeOf(std::size_t column, std::size_t row) const {
    return (row / kSide * squaresAcross_ + column / kSide) * kSide * kSide + row % kSide * kSide + column % kSide;
  }

  int width_, height_;
  std::size_t squaresAcross_;
  std::vector<std::uint8_t> texels_; ///< of whole squares
};

/// The same in all of a texture's levels, the picture's own first, the last of one texel.
class AlphaLevels {
 public:
  explicit AlphaLevels(AlphaPlane largest);

  const AlphaPlane& largest() const { return levels_.front(); }
  const AlphaPlane& of(std::size_t level) const { return levels_[level]; } ///< REQUIRES: level < count()
  std::size_t count() const { return levels_.size(); }
  std::size_t bytes() const;

 private:
  std::vector<AlphaPlane> levels_;
};

} // namespace gnomon
