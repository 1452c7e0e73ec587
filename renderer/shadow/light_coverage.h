#pragma once

#include "renderer/core/camera_view.h"
#include "renderer/shadow/shadow_plan.h"
#include "renderer/shadow/slice.h"

namespace gnomon {

/// The smallest sphere around all that a spot or point light reaches, relative to the eye. REQUIRES: it has a range.
Sphere reachOf(const ShadowCaster& light);

/// How large a light shows in the picture, pixels: the larger side of the frame for a directional light, for one
/// without an end, and where the camera stands within its reach; else the diameter of the circle around the picture of
/// the sphere that it reaches, no more than the larger side; 0 where that is out of view. Rounded up.
int lightSize(const ShadowCaster& light, const CameraView& view, int frameWidth, int frameHeight);

} // namespace gnomon
