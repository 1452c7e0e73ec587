#pragma once

#include <string>

#include "clients/cli/render/rendered.h"
#include "clients/cli/terminal/progress_line.h"
#include "protocol/base/result.h"
#include "protocol/evaluation/evaluation.h"
#include "protocol/spec/frame_spec.h"
#include "renderer/scene/scene_bundle.h"

namespace gnomon::cli {

/// Renders on `server` ("http://host:port"): uploads the scene unless it is there, then asks for the frame. What the
/// server refuses comes back as its own problems.
Result<Rendered> renderThere(const std::string& server, const SceneBundle& bundle, const FrameSpec& spec,
                             ProgressLine& progress);

/// The same for a plan: its JSON.
Result<std::string> planThere(const std::string& server, const SceneBundle& bundle, const FrameSpec& spec,
                              ProgressLine& progress);

/// Measures on `server`, listening to its events; `requestJson`: an EvaluationRequest.
Result<EvaluationReport> evaluateThere(const std::string& server, const SceneBundle& bundle,
                                       const std::string& requestJson, ProgressLine& progress);

} // namespace gnomon::cli
