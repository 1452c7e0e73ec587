#pragma once

#include <cmath>
#include <glm/glm.hpp>

#include "protocol/spec/scene_options.h"

namespace gnomon {

/// Between the vocabulary's triples and glm's vectors.
inline glm::dvec3 toVector(const Vec3& v) {
  return {v[0], v[1], v[2]};
}
inline Vec3 toTriple(const glm::dvec3& v) {
  return {v.x, v.y, v.z};
}

/// What turns the area of a surface as `m` turns the surface: the inverse transpose times the determinant. It needs no
/// division, so that matrices that flatten have it too: there it is a multiple of the normal of what they flatten to.
inline glm::dmat3 cofactors(const glm::dmat3& m) {
  return {glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1])};
}

/// What turns normals: the same, its sign undone where the matrix mirrors.
inline glm::dmat3 normalMatrix(const glm::dmat3& m) {
  return glm::determinant(m) < 0 ? -1.0 * cofactors(m) : cofactors(m);
}

/// The unit vector along `v`; `otherwise` where it has no direction.
inline glm::dvec3 unitOr(const glm::dvec3& v, const glm::dvec3& otherwise) {
  const double length = glm::length(v);
  return std::isfinite(length) && length > 0 ? v / length : otherwise;
}

/// Whether a transform leaves nothing of a body's volume; so does one that is not finite.
bool isFlat(const glm::dmat4& matrix);

/// Whether a transform leaves not even a surface, but a line or a point; so does one that is not finite.
bool hasNoArea(const glm::dmat4& matrix);

} // namespace gnomon
