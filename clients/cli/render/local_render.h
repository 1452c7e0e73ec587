#pragma once

#include <string>

#include "clients/cli/render/rendered.h"
#include "clients/cli/terminal/progress_line.h"
#include "protocol/base/result.h"
#include "protocol/evaluation/evaluation.h"
#include "protocol/report/replies.h"
#include "protocol/spec/frame_spec.h"
#include "renderer/scene/scene_bundle.h"

namespace gnomon::cli {

/// Renders in this process. The report gets the stages `load` and `encode` besides the renderer's own.
Result<Rendered> renderHere(const SceneBundle& bundle, const FrameSpec& spec, const BackendOptions& backend,
                            ProgressLine& progress);

/// Measures in this process.
Result<EvaluationReport> evaluateHere(const SceneBundle& bundle, const Evaluation& evaluation,
                                      const BackendOptions& backend, ProgressLine& progress);

/// Plans in this process, as JSON. The renderer is created only to ask what it can do; it draws nothing.
Result<std::string> planHere(const SceneBundle& bundle, const FrameSpec& spec, const BackendOptions& backend,
                             ProgressLine& progress);

} // namespace gnomon::cli
