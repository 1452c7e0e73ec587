#pragma once

#include <functional>
#include <string>
#include <vector>

#include "protocol/base/result.h"
#include "protocol/evaluation/evaluation.h"
#include "protocol/report/frame_report.h"

/// Settings that meet a target. Part of the door: see render.h. Pure.
namespace gnomon {

struct Scene;

/// What is tried for the shadows of `spec`, not yet measured: maps from coarse to fine, sharp ones, then the exact
/// techniques. Each changes technique, filter, cascades and sizes alone.
std::vector<QualityTrial> qualityTrials(const FrameSpec& spec);

/// `spec` with a trial's settings for every light, and without a target.
FrameSpec withTrial(const FrameSpec& spec, const QualityTrial& trial);

/// Measures every trial: a variant each, in their order.
Evaluation qualityEvaluation(const FrameSpec& spec, const std::vector<QualityTrial>& trials);

/// The choice, once all is measured. maxError: the fastest that misclassifies no more; maxMilliseconds: the most exact
/// that takes no longer, and of equally exact ones the fastest. Where nothing meets the target, the most exact, or the
/// fastest. Trials that can't be drawn are left out; if none can, the first one's problem.
Result<QualityReport> chooseTrial(const Quality& target, std::vector<QualityTrial> trials,
                                  const EvaluationReport& measured);

/// The settings that meet the target of `spec`, chosen after `measure` has evaluated every trial. Problems as `measure`
/// gives, with places in `spec`, and as chooseTrial gives.
Result<QualityReport> chooseQuality(const FrameSpec& spec,
                                    const std::function<Result<EvaluationReport>(const Evaluation&)>& measure);

/// `spec` with the settings that the report chose, and without a target.
FrameSpec withChoice(const FrameSpec& spec, const QualityReport& report);

/// Views of one scene for which one choice serves: their eyes lie in one cell of a grid, a sixteenth of the scene wide,
/// they look the same way to about 20 degrees, and their lenses differ by less than a factor of two. The camera in
/// short; nothing else of the spec. Problems as resolving the camera gives.
Result<std::string> viewClass(const Scene& scene, const FrameSpec& spec);

} // namespace gnomon
