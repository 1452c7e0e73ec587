#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>

#include "renderer/cpu/raster/raster.h"

namespace gnomon::cpu {

inline constexpr int kSubpixels = 256; ///< of a pixel's side

/// Pixels to each side of the picture's middle that corners may lie at: their differences, times those of a pixel, stay
/// within 63 bits.
inline constexpr double kGuard = 16384;

/// Where the samples of a pixel lie, in 1/256 of it from its lower left corner: the centre of one, or Direct3D's
/// standard pattern of four, which drivers of OpenGL share.
template <int samples>
inline constexpr std::array<glm::ivec2, 1> kSamplePlaces{glm::ivec2(128, 128)};
template <>
inline constexpr std::array<glm::ivec2, 4> kSamplePlaces<4>{glm::ivec2(96, 32), glm::ivec2(224, 96),
                                                            glm::ivec2(32, 160), glm::ivec2(160, 224)};

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

  std::size_t squares() const { return static_cast<std::size_t>(squaresAcross) * static_cast<std::size_t>(squaresUp); }
  /// The blocks of a square that are wanted, as TexelMarks has them.
  std::uint64_t wanted(std::size_t square) const { return only == nullptr ? ~std::uint64_t{0} : only->in(square); }

  glm::dvec2 middle() const { return glm::dvec2(width, height) * (0.5 * kSubpixels); } ///< 1/256 of a pixel
  glm::dvec2 guard() const { return kGuard / (0.5 * glm::dvec2(width, height)); }      ///< in clip space, times w
};

/// Pixels from a lower left to an upper right one, which belongs to it; none where last < first.
struct PixelBox {
  int x0 = 0, y0 = 0, x1 = -1, y1 = -1;

  bool empty() const { return x1 < x0 || y1 < y0; }
};

/// Of the picture, those that have a sample within a span of 1/256 of a pixel.
inline PixelBox pixelsWithin(const RasterView& view, const glm::ivec2& least, const glm::ivec2& most) {
  const auto first = [](int at, int lastSample) {
    const int pixel = (at - lastSample + kSubpixels - 1) >> 8;
    return pixel > 0 ? pixel : 0;
  };
  const auto last = [](int at, int firstSample, int size) {
    const int pixel = (at - firstSample) >> 8;
    return pixel < size - 1 ? pixel : size - 1;
  };
  return {first(least.x, view.lastSample.x), first(least.y, view.lastSample.y),
          last(most.x, view.firstSample.x, view.width), last(most.y, view.firstSample.y, view.height)};
}

/// Whether a square, which the pixels touch, wants any block of theirs.
inline bool isWanted(const RasterView& view, const PixelBox& pixels, int squareX, int squareY) {
  if (view.only == nullptr) return true;
  const auto block = [](int pixel, int square) {
    const int within = pixel - square * kSquareSide;
    return (within < 0 ? 0 : within < kSquareSide ? within : kSquareSide - 1) / kMarkSide;
  };
  const auto square = static_cast<std::size_t>(squareY * view.squaresAcross + squareX);
  return (view.only->in(square)&blockBits(block(pixels.x0, squareX), block(pixels.x1, squareX),
                                          block(pixels.y0, squareY), block(pixels.y1, squareY))) != 0;
}

} // namespace gnomon::cpu
