#pragma once

#include <glm/glm.hpp>

#include "renderer/core/camera_view.h"
#include "renderer/shadow/depth_interval.h"

namespace gnomon {

/// Metres from the eye to the farthest point of a slice: what a view sees between two depths.
double sliceReach(const CameraView& view, const DepthInterval& depths);

struct Sphere {
  glm::dvec3 center{0}; ///< relative to the eye
  double radius = 0;
};

/// The smallest sphere around a slice. Its radius depends on the lens and the depths, not on where the camera stands or
/// looks.
Sphere sliceSphere(const CameraView& view, const DepthInterval& depths);

} // namespace gnomon
