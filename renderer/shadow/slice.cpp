#include "renderer/shadow/slice.h"

#include <algorithm>
#include <cmath>

namespace gnomon {

double sliceReach(const CameraView& view, const DepthInterval& depths) {
  const double halfDiagonal = std::hypot(view.halfSize.x, view.halfSize.y);
  if (view.perspective) return depths.far * std::hypot(1.0, halfDiagonal);
  return std::hypot(std::max(std::abs(depths.near), std::abs(depths.far)), halfDiagonal);
}

// A sphere through the near and the far corners of a perspective slice has its centre on the axis at
// (n + f)(1 + t^2) / 2, t being the tangent to a corner; where that lies beyond the far plane, the far corners alone
// decide and the centre is in their plane.
Sphere sliceSphere(const CameraView& view, const DepthInterval& depths) {
  const double t = std::hypot(view.halfSize.x, view.halfSize.y);
  if (!view.perspective) {
    return {view.forward * (0.5 * (depths.near + depths.far)), std::hypot(0.5 * (depths.far - depths.near), t)};
  }
  const double center = std::min(depths.far, 0.5 * (depths.near + depths.far) * (1.0 + t * t));
  return {view.forward * center, std::hypot(depths.far - center, depths.far * t)};
}

} // namespace gnomon
