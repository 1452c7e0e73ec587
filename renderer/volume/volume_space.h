#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "protocol/base/result.h"
#include "renderer/core/aabb.h"
#include "renderer/core/camera_view.h"

namespace gnomon {

/// A line with a direction. In the world `direction` has unit length, so that distances along it are metres.
struct Ray {
  glm::dvec3 origin{0};
  glm::dvec3 direction{0, 0, 1};
};

inline glm::dvec3 pointAt(const Ray& ray, double distance) {
  return ray.origin + distance * ray.direction;
}

/// A piece of a ray, as distances from its origin; from <= to.
struct Interval {
  double from = 0;
  double to = 0;
};

/// The place of a volume: an affine map of the unit cube; its corner is apart from the axes, for precision.
struct VolumeSpace {
  glm::dvec3 corner{0}; ///< of the world: where the cube's 0, 0, 0 lies
  glm::dmat3 axes{1};   ///< columns: the cube's edges, metres
  glm::dmat3 inverse{1};

  bool operator==(const VolumeSpace&) const = default;
};

/// From an affine matrix, world from unit cube. A problem where it is not finite, not affine or flat.
Result<VolumeSpace> spaceOf(const glm::dmat4& worldFromUnit);

/// A box along the world's axes. A problem where it is not finite or has no inside.
Result<VolumeSpace> spaceOf(const Aabb& box);

/// The same in a space that a matrix leads to. A problem as for a matrix of its own.
Result<VolumeSpace> moved(const VolumeSpace& space, const glm::dmat4& matrix);

/// The same ray in the cube; distances along it stay what they were.
inline Ray toUnit(const VolumeSpace& space, const Ray& ray) {
  return {space.inverse * (ray.origin - space.corner), space.inverse * ray.direction};
}

inline glm::dvec3 toWorld(const VolumeSpace& space, const glm::dvec3& unit) {
  return space.corner + space.axes * unit;
}

/// Where a ray is inside the closed unit cube, on both sides of its origin.
std::optional<Interval> insideUnitCube(const Ray& unitRay);

/// What a camera sees at one place of its picture: a ray through the world, and how view depths lie on it.
struct ViewRay {
  Ray ray;
  double metresPerDepth = 1; ///< along the ray, for each metre of view depth
  Interval seen{};           ///< metres along the ray between the near and the far plane
};

/// `ndc`: the place on the picture, -1..1, y up; an orthographic ray starts at depth 0.
inline ViewRay viewRayAt(const CameraView& view, const glm::dvec2& ndc) {
  const glm::dvec3 start = pointAt(view, ndc, 0);
  const glm::dvec3 perDepth = pointAt(view, ndc, 1) - start;
  const double length = glm::length(perDepth);
  return {{view.eye + start, perDepth / length}, length, {length * view.near, length * view.far}};
}

} // namespace gnomon
