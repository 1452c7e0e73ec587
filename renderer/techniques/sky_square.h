#pragma once

#include <cstddef>

namespace gnomon {

/// A square of a picture, and the pixels within kReach of it, row by row from the lowest: what rays say of the share of
/// an environment's light.
struct SkySquare {
  static constexpr int kSide = 16;
  static constexpr int kReach = 4;
  static constexpr int kWidth = kSide + 2 * kReach;
  static constexpr std::size_t kCount = static_cast<std::size_t>(kWidth * kWidth);
  static constexpr std::size_t kOwn = static_cast<std::size_t>(kSide * kSide); ///< pixels of the square itself

  alignas(64) float share[4][kCount]; ///< rgb of the diffuse light, a of the mirrored
  float weight[kCount];               ///< of rgb; 0 = nothing is known
  float mirror[kCount];               ///< of a
  float noise[kCount];                ///< variance that rays leave in a share of a half
  float point[3][kCount];             ///< that a pixel shows, relative to any place
  float normal[3][kCount];            ///< unit length
  bool oneSurface;                    ///< all pixels of the picture show one, which turns little: no two are compared
  int shows[kCount];                  ///< -1: a surface that shows shadows; else 0, and point and normal mean nothing
};

/// The pixels of the square itself, row by row.
struct EvenSky {
  alignas(64) float share[4][SkySquare::kOwn];
  float
      uneven[SkySquare::kOwn]; ///< 0..1: how far the pixels within 2 vary from a plane more than noise would have them
};

/// Fits planes to the shares of one surface around each pixel (weighted least squares), so that no slope changes them:
/// over 5 x 5 pixels, and if `wide` over 9 x 9; those farthest off count by halves, so that each of the 4 x 4 or 8 x 8
/// sets of places (PixelPlaces) counts as much. A pixel takes the plane's share where those around vary from it as
/// noise would have them, that of the smaller square or its own where they vary by much more, and between, some of
/// both.
EvenSky evenOut(const SkySquare& square, bool wide);

} // namespace gnomon
