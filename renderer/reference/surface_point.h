#pragma once

#include "renderer/reference/trace.h"
#include "renderer/reference/triangle.h"

namespace gnomon {

/// Where a camera ray of this direction crosses a triangle. `at`: as crossing() gives it.
inline SurfacePoint surfacePoint(const glm::dvec3& direction, const PlacedTriangle& on, const Triangle& triangle,
                                 const Barycentric& at) {
  const glm::dvec3 area = triangle.area();
  const bool away = glm::dot(area, direction) > 0;
  return {at.mix(triangle.a, triangle.b, triangle.c), glm::vec3(unitAlong(away ? -area : area)), on.instance,
          on.triangle};
}

} // namespace gnomon
