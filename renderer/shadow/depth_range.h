#pragma once

#include <optional>

#include "protocol/shadow_options.h"
#include "renderer/core/camera_view.h"
#include "renderer/shadow/depth_interval.h"
#include "renderer/shadow/shadow_plan.h"

namespace gnomon {

/// How far a depth that a shader computes may lie from the surveyed one: metres, at view depth `depth`. Floats and a
/// 32-bit depth buffer keep 6e-8 of the depth (perspective) or of far - near (orthographic); this leaves room for the
/// handful of roundings between them.
double depthSlack(const CameraView& view, double depth);

/// The view depths that the cascades of a light cover; near < far. Empty where nothing is in view.
/// Automatic: from the nearest to the farthest surface, widened by depthSlack. Manual: min and max beyond the camera's
/// near plane (absent: 0 and 50 m), as asked. A range too thin to be cut is widened.
std::optional<DepthInterval> depthRangeOf(const CameraView& view, const ReceiverDepths& receivers,
                                          const DepthRange& options);

} // namespace gnomon
