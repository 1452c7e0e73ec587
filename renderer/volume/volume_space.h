#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "protocol/base/result.h"
#include "renderer/core/aabb.h"

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

/// Where a volume is: the unit cube, moved, turned, stretched and sheared into the world. The corner is kept apart from
/// the axes, so that digits are kept far from the origin.
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

/// Where a ray is inside the closed unit cube, on both sides of its origin. A ray along a face that lies in it is
/// inside.
std::optional<Interval> insideUnitCube(const Ray& unitRay);

} // namespace gnomon
