#pragma once

#include "protocol/frame_report.h"
#include "renderer/draw_views.h"
#include "renderer/resolve_frame.h"

namespace gnomon {

/// What happened, told from what the stages returned.
FrameReport makeReport(const ResolvedFrame& frame, const SceneView& scene, const Survey& survey, const ShadowPlan& plan,
                       const ShadowAtlas& atlas, const DrawnViews& drawn, std::vector<StageTime> stages);

} // namespace gnomon
