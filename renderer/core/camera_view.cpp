#include "renderer/core/camera_view.h"

#include <algorithm>
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
    const double scale = 1.0 / (drawnFar(view) - drawnNear(view));
    matrix[2][2] = scale;
    matrix[3][2] = drawnFar(view) * scale;
    matrix[3][3] = 1.0;
    return matrix;
  }
  // The middle comes to lie at 0: depth is -z of view space, and w.
  matrix[2][0] = view.center.x / view.halfSize.x;
  matrix[2][1] = view.center.y / view.halfSize.y;
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

double viewDepthOf(const CameraView& view, double depth) {
  const glm::dmat4 clip = clipFromView(view);
  const double a = clip[2][2];
  const double b = clip[3][2];
  return view.perspective ? b / (depth + a) : (b - depth) / a;
}

Frustum frustumOf(const CameraView& view) {
  // A side plane of a perspective view holds the eye: right . p + (halfSize.x - center.x) * depth(p) >= 0. An
  // orthographic one does not: right . p + halfSize.x >= 0.
  const glm::dvec3 widen = view.perspective ? view.forward : glm::dvec3(0.0);
  const double offset = view.perspective ? 0.0 : 1.0;
  const auto side = [&](const glm::dvec3& axis, double half) { return glm::dvec4(axis + widen * half, offset * half); };

  Frustum frustum;
  frustum.planes[0] = side(view.right, view.halfSize.x - view.center.x);
  frustum.planes[1] = side(-view.right, view.halfSize.x + view.center.x);
  frustum.planes[2] = side(view.up, view.halfSize.y - view.center.y);
  frustum.planes[3] = side(-view.up, view.halfSize.y + view.center.y);
  frustum.planes[4] = glm::dvec4(view.forward, -view.near);
  frustum.planes[5] = std::isinf(view.far) ? glm::dvec4(0, 0, 0, 1) : glm::dvec4(-view.forward, view.far);
  return frustum;
}

bool mayIntersect(const Frustum& frustum, const Aabb& box) {
  if (box.empty()) return false;
  // Rounding must never reject a box that touches a plane: four products and sums lose at most a few 2^-53 of the sum
  // of magnitudes.
  constexpr double kRounding = 1e-14;
  for (const glm::dvec4& plane : frustum.planes) {
    const glm::dvec3 normal(plane);
    const glm::dvec3 innermost = glm::mix(box.min, box.max, glm::greaterThanEqual(normal, glm::dvec3(0.0)));
    const glm::dvec3 products = normal * innermost;
    const double magnitude = std::abs(products.x) + std::abs(products.y) + std::abs(products.z) + std::abs(plane.w);
    if (products.x + products.y + products.z + plane.w < -kRounding * magnitude) return false;
  }
  return true;
}

std::vector<glm::dvec3> clipped(const std::vector<glm::dvec3>& polygon, const glm::dvec4& plane) {
  const auto inside = [&](const glm::dvec3& p) { return glm::dot(glm::dvec3(plane), p) + plane.w; };
  std::vector<glm::dvec3> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec3& from = polygon[i];
    const glm::dvec3& to = polygon[(i + 1) % polygon.size()];
    const double a = inside(from);
    const double b = inside(to);
    if (a >= 0) kept.push_back(from);
    if ((a > 0 && b < 0) || (a < 0 && b > 0)) kept.push_back(glm::mix(from, to, a / (a - b)));
  }
  return kept;
}

std::vector<BlockStrip> blockStrips(int count, int blockSize, int pixels, const glm::dvec3& axis) {
  constexpr double kMargin = 0.5; // pixels
  const auto at = [&](double pixel) { return axis * (2.0 * pixel / pixels - 1.0); };
  std::vector<BlockStrip> strips;
  for (int i = 0; i < count; ++i) {
    const glm::dvec3 first = at(i * blockSize - kMargin);
    const glm::dvec3 last = at(std::min((i + 1) * blockSize, pixels) + kMargin);
    strips.push_back({glm::min(first, last), glm::max(first, last)});
  }
  return strips;
}

Aabb blockPiece(bool perspective, const glm::dvec3& middle, const BlockStrip& column, const BlockStrip& row,
                double from, double to) {
  const glm::dvec3 low = column.low + row.low;
  const glm::dvec3 high = column.high + row.high;
  // A coordinate is linear in the depth, so its extremes are at the ends.
  if (!perspective) {
    return {low + glm::min(middle * from, middle * to), high + glm::max(middle * from, middle * to)};
  }
  return {glm::min((middle + low) * from, (middle + low) * to), glm::max((middle + high) * from, (middle + high) * to)};
}

} // namespace gnomon
