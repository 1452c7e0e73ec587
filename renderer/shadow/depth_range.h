#pragma once

#include <optional>
#include <string>

#include "protocol/spec/shadow_options.h"
#include "renderer/core/camera_view.h"
#include "renderer/shadow/shadow_plan.h"
#include "renderer/shadow/splits.h"

namespace gnomon {

/// How far a depth that a shader computes may lie from the surveyed one: metres, at view depth `depth`. Floats and a
/// 32-bit depth buffer keep 6e-8 of the depth (perspective) or of far - near (orthographic); this leaves room for the
/// handful of roundings between them.
double depthSlack(const CameraView& view, double depth);

/// The depths of a light's cascades; near < far in both.
struct PlannedRange {
  DepthInterval base;    ///< what the next frame of a sequence takes as its `previous`
  DepthInterval covered; ///< the base, with the guard on both ends where there was a previous range
  std::string note;      ///< why a previous range was not kept; empty = it was, or there was none
};

/// The view depths that the cascades of a light cover. Empty where nothing is in view.
/// Automatic: from the nearest to the farthest surface, widened by depthSlack. Manual: min and max beyond the camera's
/// near plane (absent: 0 and 50 m), as asked. A range too thin to be cut is widened.
/// Automatic with a previous range: that range and the guard on both ends, within the camera's near and far planes. An
/// end beyond which a surface lies moves outwards by as many steps of a tenth as it takes; one that could move inwards
/// by a factor of two does so: near to near / 1.1^n or near * 2^n, far to far * 1.1^n or far / 2^n (the steps of
/// Stride's automatic depth range). An end that is not in front of the eye, which only an orthographic camera gives,
/// has no factors: the range is then this frame's as soon as a surface lies outside or it is twice as long as it need
/// be. What comes out depends on the previous range and this frame, and on nothing else.
std::optional<PlannedRange> depthRangeOf(const CameraView& view, const ReceiverDepths& receivers,
                                         const DepthRange& options);

} // namespace gnomon
