#pragma once

#include "renderer/resolve/resolve_frame.h"
#include "renderer/shaders/shared/frame_types.h"

namespace gnomon {

/// What every shader of a frame reads; the depths of the surfaces are left at 0.
shared::FrameData frameData(const ResolvedFrame& frame);

} // namespace gnomon
