#pragma once

#include "protocol/base/result.h"
#include "protocol/report/capabilities.h"
#include "protocol/spec/frame_spec.h"
#include "renderer/shadow/shadow_plan.h"

namespace gnomon {

/// What only the device can refuse.
Status checkDevice(const FrameSpec& spec, const RendererInfo& device);

/// A problem where a planned atlas takes more memory than a frame may have.
Status checkAtlas(const ShadowPlan& plan, int samples);

} // namespace gnomon
