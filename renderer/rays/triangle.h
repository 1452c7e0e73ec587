#pragma once

#include <algorithm>
#include <glm/glm.hpp>

namespace gnomon {

/// A triangle where it is traced, relative to anchorOf(view), in metres.
struct Triangle {
  glm::dvec3 a{0}, b{0}, c{0};

  glm::dvec3 area() const { return glm::cross(b - a, c - a); } ///< twice the area, along the normal
  glm::dvec3 largest() const {                                 ///< of the coordinates' absolute values, by axis
    return glm::max(glm::max(glm::abs(a), glm::abs(b)), glm::abs(c));
  }
  /// So narrow that doubles don't know its plane.
  bool isSliver() const {
    const glm::dvec3 ab = b - a, ac = c - a, normal = area();
    return !(glm::dot(normal, normal) > 1e-8 * glm::dot(ab, ab) * glm::dot(ac, ac));
  }
};

/// Of unit length; zero where `v` has no direction.
inline glm::dvec3 unitAlong(const glm::dvec3& v) {
  const double length = glm::length(v);
  return length > 0 ? v / length : glm::dvec3(0);
}

/// Metres: how far off a plane doubles may find a point that lies in it. `largest`: of the coordinates of the point and
/// of those that the plane is known by.
inline double samePlane(const glm::dvec3& normal, const glm::dvec3& largest) {
  return 0x1p-44 * glm::dot(glm::abs(normal), largest);
}

/// A place in a triangle: its weights are 1 - u - v, u and v.
struct Barycentric {
  double u = 0;
  double v = 0;

  template <class T>
  T mix(const T& a, const T& b, const T& c) const {
    return a + u * (b - a) + v * (c - a);
  }
};

/// Where the line origin + t direction crosses the triangle's plane, as weights of any size; `otherwise` where it runs
/// along the plane. (Moeller and Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection", 1997.)
inline Barycentric crossingPlane(const Triangle& triangle, const glm::dvec3& origin, const glm::dvec3& direction,
                                 const Barycentric& otherwise) {
  const glm::dvec3 ab = triangle.b - triangle.a;
  const glm::dvec3 ac = triangle.c - triangle.a;
  const glm::dvec3 p = glm::cross(direction, ac);
  const double determinant = glm::dot(ab, p);
  if (determinant == 0) return otherwise;
  const glm::dvec3 from = origin - triangle.a;
  return {glm::dot(from, p) / determinant, glm::dot(direction, glm::cross(from, ab)) / determinant};
}

/// The same, moved to the triangle's nearest side where rounding put it outside.
inline Barycentric crossing(const Triangle& triangle, const glm::dvec3& origin, const glm::dvec3& direction,
                            const Barycentric& otherwise) {
  const Barycentric at = crossingPlane(triangle, origin, direction, otherwise);
  const double u = std::clamp(at.u, 0.0, 1.0);
  return {u, std::clamp(at.v, 0.0, 1.0 - u)};
}

} // namespace gnomon
