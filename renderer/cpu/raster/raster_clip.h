#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>

namespace gnomon::cpu {

/// A corner in clip space. `own`: which of the triangle's corners it is, -1 = clipping made it.
struct ClipCorner {
  glm::dvec4 clip{0, 0, 0, 1};
  int own = -1;
};

/// Each of six planes adds a corner at most.
struct ClipPolygon {
  std::array<ClipCorner, 9> corners;
  std::size_t count = 0;
};

/// What of a triangle lies within |x| <= guard.x w and |y| <= guard.y w, and, where `depth` says so, 0 <= z <= w. The
/// same edge is cut at the same place whichever triangle it belongs to. (Sutherland and Hodgman, "Reentrant Polygon
/// Clipping", 1974.)
ClipPolygon clipped(const std::array<glm::dvec4, 3>& triangle, const glm::dvec2& guard, bool depth);

} // namespace gnomon::cpu
