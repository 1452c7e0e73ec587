#pragma once

#include <cstddef>

namespace gnomon {

/// How far two pixels of one surface may be from lying in one plane.
struct SurfaceLimits {
  float flat;        ///< squared sine of the steepest way from a pixel to another
  float leastCosine; ///< of their normals
};

/// Whether a pixel of a square (SkySquare, ShareSquare) shows the same surface as another: -1, or 0.
template <class Square>
[[gnu::always_inline]] inline int showsSame(const Square& square, std::size_t other, std::size_t pixel,
                                            const SurfaceLimits& limits) {
  const float x = square.point[0][other] - square.point[0][pixel];
  const float y = square.point[1][other] - square.point[1][pixel];
  const float z = square.point[2][other] - square.point[2][pixel];
  const float nx = square.normal[0][pixel];
  const float ny = square.normal[1][pixel];
  const float nz = square.normal[2][pixel];
  const float along = x * nx + y * ny + z * nz;
  const float cosine = square.normal[0][other] * nx + square.normal[1][other] * ny + square.normal[2][other] * nz;
  return square.shows[other] & (along * along <= limits.flat * (x * x + y * y + z * z) ? -1 : 0) &
         (cosine >= limits.leastCosine ? -1 : 0);
}

} // namespace gnomon
