#pragma once

#include <span>
#include <vector>

#include "protocol/report/frame_report.h"
#include "renderer/device/device.h"
#include "renderer/frame/light_map_cache.h"
#include "renderer/resolve/plan_input.h"
#include "renderer/resolve/resolve_frame.h"
#include "renderer/shadow/predicted_error.h"
#include "renderer/shadow/shadow_plan.h"

namespace gnomon {

/// What the stages of a frame returned.
struct FrameOutcome {
  const ResolvedFrame& frame;
  std::uint64_t sceneTriangles; ///< of the chosen glTF scene
  DepthSpan depths;             ///< of all that the camera sees
  const FramePlans& plans;
  const PredictedErrors& errors;
  std::span<const int> layered;                ///< as in FrameWork
  std::span<const LightMapCache::Found> baked; ///< bakedLights
  std::span<const VolumeReport> volumes;       ///< volumesOf
  FrameFacts facts;
  std::optional<ErrorMetrics> error; ///< where a view compares a shadow with rays
};

/// What was baked for one light.
LightMapReport lightMapReport(const LightMapCache::Found& found);

/// What happened, in the words of protocol/report/frame_report.h.
FrameReport makeReport(FrameOutcome outcome);

bool isPlanned(const ShadowPlan& plan, int light);

/// What a plan decided about the spec's lights: everything but counts and times. `layeredLights`: those whose shadow
/// comes from rays or shadow volumes, or also does. `errors`: of plans.drawn; `wholeErrors`: of plans.whole, where they
/// are known.
std::vector<LightReport> lightReports(const ResolvedFrame& frame, const FramePlans& plans,
                                      const PredictedErrors& errors, std::span<const int> layeredLights,
                                      const PredictedErrors& wholeErrors = {});

/// From the eye that was asked for; 0 0 = nothing in view.
std::array<double, 2> askedDepths(const CameraView& view, const DepthSpan& depths);

/// Fills in the sums over a light's tiles.
void addSums(LightReport& light);

} // namespace gnomon
