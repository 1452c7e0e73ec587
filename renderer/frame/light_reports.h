#pragma once

#include <span>
#include <vector>

#include "protocol/report/frame_report.h"
#include "renderer/shadow/predicted_error.h"
#include "renderer/shadow/shadow_plan.h"

namespace gnomon {

/// What a plan decided about the spec's lights: everything but counts and times. `layeredLights`: those whose shadow
/// comes from rays or shadow volumes, or also does.
std::vector<LightReport> lightReports(const FrameSpec& spec, const ShadowPlan& plan, const PredictedErrors& errors,
                                      const glm::dvec3& eye, std::span<const int> layeredLights);

/// Fills in the sums over a light's tiles.
void addSums(LightReport& light);

} // namespace gnomon
