#pragma once

#include "clients/cli/terminal/progress.h"
#include "protocol/base/result.h"
#include "protocol/evaluation/evaluation.h"
#include "protocol/report/capabilities.h"
#include "renderer/scene/scene_bundle.h"

namespace gnomon::cli {

/// Measures in this process.
Result<EvaluationReport> evaluateHere(const SceneBundle& bundle, const Evaluation& evaluation,
                                      const BackendOptions& backend, Progress& progress);

/// Shows how far it is.
void showStep(const EvaluationStep& step, Progress& progress);

} // namespace gnomon::cli
