#include "renderer/volume/volume_space.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_access.hpp>
#include <limits>
#include <string>

namespace gnomon {
namespace {

constexpr double kMinFlatness = 1e-9;  // of a volume, to the product of its edges
constexpr double kParallel = 1e-12;    // of a component of a direction, to the largest
constexpr double kFaceRounding = 1e-9; // of the cube's edge

Problem badPlacement(const std::string& detail) {
  return {ProblemCode::invalidValue, "", detail};
}

} // namespace

Result<VolumeSpace> spaceOf(const glm::dmat4& worldFromUnit) {
  if (!finite(worldFromUnit)) return badPlacement("A volume's matrix has numbers that are not finite.");
  if (glm::row(worldFromUnit, 3) != glm::dvec4(0, 0, 0, 1)) {
    return badPlacement("A volume's matrix is not affine: its last row is not 0, 0, 0, 1.");
  }
  const glm::dmat3 axes(worldFromUnit);
  // Each edge by its length: volumes may be thin, but not flat.
  const glm::dvec3 lengths(glm::length(axes[0]), glm::length(axes[1]), glm::length(axes[2]));
  const glm::dmat3 directions(axes[0] / lengths.x, axes[1] / lengths.y, axes[2] / lengths.z);
  if (!finite(1.0 / lengths) || !finite(lengths) || !(std::abs(glm::determinant(directions)) > kMinFlatness)) {
    return badPlacement("A volume's matrix makes it flat.");
  }
  // The inverse of directions times lengths.
  glm::dmat3 inverse = glm::inverse(directions);
  for (int column = 0; column < 3; ++column) inverse[column] /= lengths;
  return VolumeSpace{glm::dvec3(worldFromUnit[3]), axes, inverse};
}

Result<VolumeSpace> spaceOf(const Aabb& box) {
  const glm::dvec3 size = box.max - box.min;
  if (!finite(box.min) || !finite(size)) return badPlacement("A volume's box is not finite.");
  if (!(std::min({size.x, size.y, size.z}) > 0)) {
    return badPlacement("A volume's box has no inside: each of its maximum is larger than its minimum.");
  }
  glm::dmat4 matrix(1);
  for (int axis = 0; axis < 3; ++axis) matrix[axis][axis] = size[axis];
  matrix[3] = glm::dvec4(box.min, 1);
  return spaceOf(matrix);
}

Result<VolumeSpace> moved(const VolumeSpace& space, const glm::dmat4& matrix) {
  glm::dmat4 own(space.axes);
  own[3] = glm::dvec4(space.corner, 1);
  return spaceOf(matrix * own);
}

std::optional<Interval> insideUnitCube(const Ray& unitRay) {
  const glm::dvec3 size = glm::abs(unitRay.direction);
  const double parallel = kParallel * std::max({size.x, size.y, size.z});
  Interval inside{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  for (int axis = 0; axis < 3; ++axis) {
    const double origin = unitRay.origin[axis];
    if (size[axis] <= parallel) {
      if (origin < -kFaceRounding || origin > 1 + kFaceRounding) return std::nullopt;
      continue;
    }
    const double low = -origin / unitRay.direction[axis];
    const double high = (1 - origin) / unitRay.direction[axis];
    inside.from = std::max(inside.from, std::min(low, high));
    inside.to = std::min(inside.to, std::max(low, high));
  }
  return inside.from <= inside.to ? std::optional(inside) : std::nullopt;
}

} // namespace gnomon
