#include "renderer/scene/graph/placing.h"

#include <cmath>

namespace gnomon {

namespace {

/// Volume of the unit cube's image per volume of a box with the same edges: below this, a transform is flat.
constexpr double kFlatVolume = 1e-12;

} // namespace

bool isFlat(const glm::dmat4& matrix) {
  double volume = glm::determinant(glm::dmat3(matrix));
  for (int axis = 0; axis < 3; ++axis) {
    const double edge = glm::length(glm::dvec3(matrix[axis]));
    if (!(edge > 0) || !std::isfinite(edge)) return true;
    volume /= edge;
  }
  return !(std::abs(volume) > kFlatVolume);
}

} // namespace gnomon
