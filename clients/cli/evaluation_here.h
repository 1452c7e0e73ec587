#pragma once

#include "clients/cli/progress.h"
#include "protocol/capabilities.h"
#include "protocol/evaluation.h"
#include "protocol/result.h"
#include "renderer/scene/scene_bundle.h"

namespace gnomon::cli {

/// Measures in this process.
Result<EvaluationReport> evaluateHere(const SceneBundle& bundle, const Evaluation& evaluation,
                                      const BackendOptions& backend, Progress& progress);

/// Shows how far it is.
void showStep(const EvaluationStep& step, Progress& progress);

} // namespace gnomon::cli
