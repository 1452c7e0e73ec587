#pragma once

#include "protocol/report/frame_report.h"
#include "renderer/frame/draw_views.h"
#include "renderer/resolve/resolve_frame.h"
#include "renderer/shadow/predicted_error.h"

namespace gnomon {

/// What the stages of a frame returned.
struct FrameStages {
  const ResolvedFrame& frame;
  const SceneView& scene;
  const GpuScene& gpu;
  const Survey& survey;
  const ShadowPlan& plan;
  const PredictedErrors& errors;
  const ShadowAtlas& atlas;
  const DrawnViews& drawn;
  std::optional<ErrorMetrics> error; ///< where a view holds a shadow against rays
};

/// What happened, told from what the stages returned. Reads the timers, so that it waits for the device if that is not
/// done.
FrameReport makeReport(const FrameStages& stages, std::vector<StageTime> times);

} // namespace gnomon
