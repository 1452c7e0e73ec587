#pragma once

#include "server/worker/orders.h"

namespace gnomon {

/// Measures. Every frame takes its turn on the render thread, so that other clients' frames are drawn in between.
/// Problems: evaluate()'s, tooLarge, deadlineExceeded.
Result<EvaluationReport> evaluateScene(WorkContext& context, const LoadedScene& scene, const Evaluation& evaluation,
                                       const OrderCall& call, const EvaluationListener& listener = {});

/// The settings that meet the target of `spec`: those of an earlier frame of this scene and class of views, or else
/// found by drawing and measuring many frames. Problems as an evaluation gives, with places in `spec`.
Result<QualityReport> settleQuality(WorkContext& context, const LoadedScene& scene, const FrameSpec& spec,
                                    const OrderCall& call);

} // namespace gnomon
