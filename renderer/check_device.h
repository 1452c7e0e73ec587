#pragma once

#include "protocol/capabilities.h"
#include "protocol/frame_spec.h"
#include "protocol/result.h"

namespace gnomon {

/// What only the device can refuse.
Status checkDevice(const FrameSpec& spec, const RendererInfo& device);

} // namespace gnomon
