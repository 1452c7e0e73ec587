#include "renderer/core/linear_algebra.h"

#include <algorithm>
#include <cmath>

namespace gnomon {
namespace {

/// Volume of the unit cube's image per volume of a box with the same edges: below this, a transform is flat.
constexpr double kFlatVolume = 1e-12;

/// Shortest edge of the unit cube's image by the longest: below this, a transform is flat.
constexpr double kFlatEdge = 1e-15;

/// Area of the largest face of the unit cube's image by the square of its longest edge: below this, it is a line.
constexpr double kLeastArea = 1e-12;

double longestOf(const glm::dmat3& m) {
  return std::max({glm::length(m[0]), glm::length(m[1]), glm::length(m[2])});
}

} // namespace

bool isFlat(const glm::dmat4& matrix) {
  const glm::dmat3 linear(matrix);
  double volume = glm::determinant(linear);
  const double longest = longestOf(linear);
  for (int axis = 0; axis < 3; ++axis) {
    const double edge = glm::length(linear[axis]);
    if (!(edge > kFlatEdge * longest) || !std::isfinite(edge)) return true;
    volume /= edge;
  }
  return !(std::abs(volume) > kFlatVolume);
}

bool hasNoArea(const glm::dmat4& matrix) {
  const glm::dmat3 linear(matrix);
  const double longest = longestOf(linear);
  return !(longestOf(cofactors(linear / longest)) > kLeastArea) || !std::isfinite(longest);
}

} // namespace gnomon
