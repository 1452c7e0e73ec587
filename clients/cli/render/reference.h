#pragma once

#include <string>

#include "protocol/base/result.h"
#include "protocol/evaluation/evaluation.h"
#include "protocol/spec/frame_spec.h"

/// The truth that a frame's shadows are held against.
namespace gnomon::cli {

/// The frame that was drawn, as its report echoes the request: what the server or the scene has chosen is settled.
Result<FrameSpec> drawnSpec(const std::string& reportJson);

/// The same frame with exact shadows: every light's are traced, with at least 256 rays a pixel towards those that have
/// a size.
FrameSpec withExactShadows(FrameSpec spec);

/// The evaluation that measures the error of the frame's shadows, as JSON: an EvaluationRequest of one variant.
std::string errorRequest(FrameSpec spec);

/// "out/frame.png" -> "out/frame.reference.png".
std::string referenceName(const std::string& output);

/// Of an evaluation of one frame its metrics, or why there are none.
Result<ErrorMetrics> metricsOf(const EvaluationReport& measured);

/// The frame's report with a member `reference`, which holds the metrics. REQUIRES: that there are some.
std::string withMetrics(const std::string& reportJson, const EvaluationReport& measured);

} // namespace gnomon::cli
