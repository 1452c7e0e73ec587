#pragma once

#include "protocol/base/result.h"
#include "protocol/report/frame_report.h"
#include "protocol/report/replies.h"
#include "renderer/frame/frame.h"

/// Part of the door: see render.h.
namespace gnomon {

/// What rendering `spec` on a device of that kind would do, without one: bounds replace what the camera sees. Any
/// thread. The same problems as render gives, but for those of files that drawing reads, and of what is drawn.
Result<PlanReport> planFrame(const ScenePtr& scene, const FrameSpec& spec, const RendererInfo& device);

} // namespace gnomon
