#pragma once

#include <string>

#include "clients/cli/terminal/progress.h"
#include "protocol/base/result.h"
#include "protocol/evaluation/evaluation.h"
#include "renderer/scene/scene_bundle.h"

namespace gnomon::cli {

/// Measures on `server`, listening to its events; `requestJson`: an EvaluationRequest.
Result<EvaluationReport> evaluateThere(const std::string& server, const SceneBundle& bundle,
                                       const std::string& requestJson, Progress& progress);

} // namespace gnomon::cli
