#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "renderer/cpu/raster/raster.h"

namespace gnomon::cpu {

inline constexpr int kSubpixels = 256; ///< of a pixel's side

/// Pixels to each side of the picture's middle that corners may lie at: their differences, times those of a pixel, stay
/// within 63 bits.
inline constexpr double kGuard = 16384;

/// What the corners of a picture are rastered by.
struct RasterView {
  int width = 0;
  int height = 0;
  int samples = 1;
  DepthRange range = DepthRange::reversed;
  glm::ivec2 firstSample{0}; ///< least and greatest place of a sample in its pixel, 1/256
  glm::ivec2 lastSample{0};
  int squaresAcross = 0;
  int squaresUp = 0;
  const TexelMarks* only = nullptr; ///< as RasterInput's

  /// The blocks of a square that are wanted, as TexelMarks has them.
  std::uint64_t wanted(std::size_t square) const { return only == nullptr ? ~std::uint64_t{0} : only->in(square); }

  glm::dvec2 middle() const { return glm::dvec2(width, height) * (0.5 * kSubpixels); } ///< 1/256 of a pixel
  glm::dvec2 guard() const { return kGuard / (0.5 * glm::dvec2(width, height)); }      ///< in clip space, times w
};

/// Pixels that have a sample within a span of 1/256 of a pixel; `last < first` where none has.
struct PixelSpan {
  int first = 0;
  int last = -1;
};

inline PixelSpan pixelsWithin(std::int32_t least, std::int32_t most, int firstSample, int lastSample, int size) {
  const int first = (least - lastSample + kSubpixels - 1) >> 8;
  const int last = (most - firstSample) >> 8;
  return {first > 0 ? first : 0, last < size - 1 ? last : size - 1};
}

} // namespace gnomon::cpu
