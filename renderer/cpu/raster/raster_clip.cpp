#include "renderer/cpu/raster/raster_clip.h"

#include <span>

namespace gnomon::cpu {
namespace {

/// Inside where dot(plane, clip) >= 0. An edge is cut from its inner end, so that both triangles that share it agree.
ClipPolygon cut(const ClipPolygon& polygon, const glm::dvec4& plane) {
  ClipPolygon kept;
  for (std::size_t i = 0; i < polygon.count; ++i) {
    const ClipCorner& from = polygon.corners[i];
    const ClipCorner& to = polygon.corners[(i + 1) % polygon.count];
    const double fromSide = glm::dot(plane, from.clip);
    const double toSide = glm::dot(plane, to.clip);
    if (fromSide >= 0) kept.corners[kept.count++] = from;
    if ((fromSide >= 0) == (toSide >= 0)) continue;
    const bool outwards = fromSide >= 0;
    const glm::dvec4& inner = outwards ? from.clip : to.clip;
    const glm::dvec4& outer = outwards ? to.clip : from.clip;
    const double innerSide = outwards ? fromSide : toSide;
    const double outerSide = outwards ? toSide : fromSide;
    kept.corners[kept.count++] = {inner + (outer - inner) * (innerSide / (innerSide - outerSide)), -1};
  }
  return kept;
}

} // namespace

ClipPolygon clipped(const std::array<glm::dvec4, 3>& triangle, const glm::dvec2& guard, bool depth) {
  const std::array planes{glm::dvec4(0, 0, -1, 1),       glm::dvec4(0, 0, 1, 0),       glm::dvec4(1, 0, 0, guard.x),
                          glm::dvec4(-1, 0, 0, guard.x), glm::dvec4(0, 1, 0, guard.y), glm::dvec4(0, -1, 0, guard.y)};
  ClipPolygon polygon;
  for (int i = 0; i < 3; ++i) polygon.corners[polygon.count++] = {triangle[static_cast<std::size_t>(i)], i};
  for (const glm::dvec4& plane : std::span(planes).subspan(depth ? 0 : 2)) {
    polygon = cut(polygon, plane);
    if (polygon.count < 3) return {};
  }
  return polygon;
}

} // namespace gnomon::cpu
