#pragma once

#include <array>
#include <glm/glm.hpp>

#include "renderer/cpu/raster/raster_triangles.h"
#include "renderer/cpu/raster/raster_view.h"

namespace gnomon::cpu {

/// A corner before it is snapped.
struct WideCorner {
  glm::dvec4 clip{0};  ///< in clip space
  bool placed = false; ///< else it lies where nothing is rastered, and has no place
  glm::dvec2 at{0};    ///< 1/256 of a pixel from the picture's lower left corner
  double z = 0;        ///< depth
};

/// Triangles of a draw that are not small.
struct WideDraw {
  const RasterView& view;
  Facing facing = Facing::both;
  bool holed = false;
};

/// Adds what of a triangle may cover samples, and the squares that it may touch. Where a corner has no place
/// the triangle is clipped.
void addWide(const WideDraw& draw, const std::array<WideCorner, 3>& corners, std::uint32_t number,
             TriangleGroup& group);

} // namespace gnomon::cpu
