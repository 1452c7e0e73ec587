#pragma once

#include "protocol/base/result.h"
#include "protocol/report/frame_report.h"
#include "protocol/report/replies.h"

/// Part of the door: see render.h.
namespace gnomon {

struct Scene;

/// What rendering `spec` on a device of that kind would do, without one: bounds stand in for what the camera sees. Any
/// thread. The same problems as render gives.
Result<PlanReport> planFrame(const Scene& scene, const FrameSpec& spec, const RendererInfo& device);

} // namespace gnomon
