#pragma once

#include <glm/glm.hpp>

#include "renderer/core/camera_view.h"
#include "renderer/volume/volume_space.h"

namespace gnomon {

/// What a camera sees at one place of its picture: a ray through the world, and how view depths lie on it.
struct ViewRay {
  Ray ray;
  double metresPerDepth = 1; ///< along the ray, for each metre of view depth
  Interval seen{};           ///< metres along the ray between the near and the far plane
};

/// `ndc`: the place on the picture, -1..1, y up. An orthographic ray's depth 0 is where its origin is, too, so that
/// what is seen may begin behind it.
inline ViewRay viewRayAt(const CameraView& view, const glm::dvec2& ndc) {
  const glm::dvec3 start = pointAt(view, ndc, 0);
  const glm::dvec3 perDepth = pointAt(view, ndc, 1) - start;
  const double length = glm::length(perDepth);
  return {{view.eye + start, perDepth / length}, length, {length * view.near, length * view.far}};
}

} // namespace gnomon
