#pragma once

#include "protocol/report/frame_report.h"
#include "renderer/device/facts.h"
#include "renderer/resolve/resolve_frame.h"
#include "renderer/shadow/predicted_error.h"

namespace gnomon {

/// What the stages of a frame returned.
struct FrameOutcome {
  const ResolvedFrame& frame;
  std::uint64_t sceneTriangles; ///< of the chosen glTF scene
  DepthSpan depths;             ///< of all that the camera sees
  const ShadowPlan& plan;
  const PredictedErrors& errors;
  std::span<const int> layered; ///< as in FrameWork
  FrameFacts facts;
  std::optional<ErrorMetrics> error; ///< where a view compares a shadow with rays
};

/// What happened, in the words of protocol/report/frame_report.h.
FrameReport makeReport(FrameOutcome outcome);

} // namespace gnomon
