#include "renderer/core/camera_view.h"

#include <cmath>

namespace gnomon {

glm::dmat4 viewFromRelative(const CameraView& view) {
  glm::dmat4 matrix(1.0);
  for (int axis = 0; axis < 3; ++axis) {
    matrix[axis] = glm::dvec4(view.right[axis], view.up[axis], -view.forward[axis], 0.0);
  }
  return matrix;
}

glm::dmat4 clipFromView(const CameraView& view) {
  glm::dmat4 matrix(0.0);
  matrix[0][0] = 1.0 / view.halfSize.x;
  matrix[1][1] = 1.0 / view.halfSize.y;
  if (!view.perspective) {
    // z = (far - depth) / (far - near), with depth = -z of view space.
    const double scale = 1.0 / (view.far - view.near);
    matrix[2][2] = scale;
    matrix[3][2] = view.far * scale;
    matrix[3][3] = 1.0;
    return matrix;
  }
  matrix[2][3] = -1.0;
  if (std::isinf(view.far)) {
    matrix[3][2] = view.near; // z / w = near / depth
    return matrix;
  }
  // z / w = near (far - depth) / (depth (far - near))
  const double scale = view.near / (view.far - view.near);
  matrix[2][2] = scale;
  matrix[3][2] = view.far * scale;
  return matrix;
}

} // namespace gnomon
