#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

namespace gnomon {

/// What turns the area of a surface as `m` turns the surface: the inverse transpose times the determinant. It needs no
/// division, so that matrices that flatten have it too: there it is a multiple of the normal of what they flatten to.
inline glm::dmat3 cofactors(const glm::dmat3& m) {
  return {glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1])};
}

/// What turns normals: the same, its sign undone where the matrix mirrors.
inline glm::dmat3 normalMatrix(const glm::dmat3& m) {
  return glm::determinant(m) < 0 ? -1.0 * cofactors(m) : cofactors(m);
}

/// Whether `m` leaves so little of one direction (less than 1e-15 of the longest) that rounding decides which side is
/// which: what it turns is a sheet.
inline bool flattens(const glm::dmat3& m) {
  const double longest = std::sqrt(std::max({glm::dot(m[0], m[0]), glm::dot(m[1], m[1]), glm::dot(m[2], m[2])}));
  return !(std::abs(glm::determinant(m)) > 1e-15 * longest * longest * longest);
}

/// The unit vector along `v`; `otherwise` where it has no direction.
inline glm::dvec3 unitOr(const glm::dvec3& v, const glm::dvec3& otherwise) {
  const double length = glm::length(v);
  return std::isfinite(length) && length > 0 ? v / length : otherwise;
}

} // namespace gnomon
