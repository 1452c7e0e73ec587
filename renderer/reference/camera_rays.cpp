#include "renderer/reference/camera_rays.h"

#include <algorithm>
#include <cmath>

namespace gnomon {
namespace {

struct Stretch {
  double from = -std::numeric_limits<double>::infinity();
  double to = std::numeric_limits<double>::infinity();
};

/// What lies in the box of a line (Kay and Kajiya, "Ray Tracing Complex Scenes", 1986).
Stretch stretchIn(const Aabb& box, const glm::dvec3& origin, const glm::dvec3& direction) {
  Stretch inside;
  for (int axis = 0; axis < 3; ++axis) {
    const double low = (box.min[axis] - origin[axis]) / direction[axis];
    const double high = (box.max[axis] - origin[axis]) / direction[axis];
    // fmin and fmax pass over what is not a number: an origin in the very side that the line runs along.
    inside.from = std::fmax(inside.from, std::fmin(low, high));
    inside.to = std::fmin(inside.to, std::fmax(low, high));
  }
  return inside;
}

Aabb grown(const Aabb& box) {
  const glm::dvec3 half = box.halfExtent();
  const double margin = std::max({half.x, half.y, half.z}) / 64;
  return {box.min - margin, box.max + margin};
}

} // namespace

SightLine sightLine(const CameraView& view, const glm::dvec3& anchor, glm::dvec2 size, glm::dvec2 place) {
  const glm::dvec2 ndc(2 * place.x / size.x - 1, 1 - 2 * place.y / size.y);
  return {view.eye - anchor + pointAt(view, ndc, 0), view.perspective ? pointAt(view, ndc, 1) : view.forward};
}

CameraRay cameraRay(const CameraView& view, const glm::dvec3& anchor, const Aabb& bounds, glm::dvec2 size,
                    glm::dvec2 place) {
  CameraRay ray;
  if (bounds.empty()) return ray;
  const SightLine line = sightLine(view, anchor, size, place);
  ray.direction = line.direction;
  const Stretch inside = stretchIn(grown(bounds), line.origin, line.direction);
  const double from = std::max(view.near, inside.from);
  ray.meets = from <= std::min(view.far, inside.to);
  if (!ray.meets) return ray;
  ray.origin = line.origin + line.direction * from;
  ray.length = view.far - from;
  return ray;
}

} // namespace gnomon
