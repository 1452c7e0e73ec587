#pragma once

#include "renderer/frame/frame.h"
#include "renderer/resolve/resolve_frame.h"

namespace gnomon {

/// A problem for each light whose shadow a light map holds, where the pose moves something. `asked`: the spec before it
/// was settled, whose fields are pointed at.
Status checkBaked(const ScenePtr& loaded, const ScenePtr& posed, const FrameSpec& asked, const ResolvedFrame& frame);

} // namespace gnomon
