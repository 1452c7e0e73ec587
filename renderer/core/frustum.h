#pragma once

#include <array>
#include <glm/glm.hpp>

#include "renderer/core/aabb.h"
#include "renderer/core/camera_view.h"

namespace gnomon {

/// The planes of a view, eye-relative; a point p is inside where dot(plane.xyz, p) + plane.w >= 0.
/// An infinite far plane is (0,0,0,1).
struct Frustum {
  std::array<glm::dvec4, 6> planes{};
};

Frustum frustumOf(const CameraView& view);

/// False only where the box is surely outside: a box across a corner may be kept.
bool mayIntersect(const Frustum& frustum, const Aabb& box);

} // namespace gnomon
