#pragma once

#include "protocol/base/result.h"
#include "protocol/report/replies.h"
#include "protocol/spec/frame_spec.h"
#include "renderer/resolve/resolve_frame.h"
#include "renderer/shadow/shadow_plan.h"

namespace gnomon {

/// Where a spec, as it was asked for, says what the shadow of a light is. A JSON Pointer.
std::string shadowPlace(const FrameSpec& asked, int light);

/// What only the device can refuse.
Status checkDevice(const FrameSpec& spec, const RendererInfo& device);

/// A problem where a planned atlas takes more memory than a frame may have.
Status checkAtlas(const ShadowPlan& plan, int samples);

/// A problem for each light whose technique can't serve all that casts from it: shadow volumes have no holes, so that
/// every caster must be opaque. `asked`: the spec before it was settled, whose fields are pointed at.
Status checkTechniques(const FrameSpec& asked, const Scene& scene, const ResolvedFrame& frame);

} // namespace gnomon
