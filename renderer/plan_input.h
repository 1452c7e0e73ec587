#pragma once

#include "renderer/resolve_frame.h"
#include "renderer/shadow/shadow_plan.h"

namespace gnomon {

/// What the shadows of a frame are planned from. `receivers`: what the camera sees.
PlanInput planInput(const ResolvedFrame& frame, const SceneView& scene, const ReceiverDepths& receivers,
                    int maxTextureSize);

} // namespace gnomon
