#pragma once

#include <span>
#include <string>
#include <vector>

#include "renderer/frame/light_map_cache.h"
#include "renderer/resolve/resolve_frame.h"
#include "renderer/scene/scene.h"
#include "renderer/shadow/predicted_error.h"
#include "renderer/shadow/shadow_plan.h"

namespace gnomon {

/// A frame as far as its warnings ask.
struct WarnedFrame {
  const Scene& scene; ///< posed
  const SceneView& view;
  const ResolvedFrame& frame;
  const ReceiverDepths& seen;
  const ShadowPlan& plan;
  const PredictedErrors& errors;
  std::span<const int> layered; ///< lights whose shadow rays, light maps or shadow volumes draw, or also draw
};

/// What is wrong with a frame's picture, or likely not meant: one sentence a rule and a light, with the
/// number that shows it and what to set. What only drawing finds out, surfaces that face away, is left out of plans.
enum class WarnedBy { plan, drawing };
std::vector<std::string> frameWarnings(const WarnedFrame& warned, WarnedBy by,
                                       std::span<const LightMapCache::Found> baked = {});

} // namespace gnomon
