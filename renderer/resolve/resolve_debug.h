#pragma once

#include <span>

#include "protocol/base/result.h"
#include "protocol/spec/frame_spec.h"
#include "renderer/shadow/shadow_plan.h"

namespace gnomon {

/// What a frame's debug views show, settled on its plan.
struct DebugSubject {
  int light = -1;                ///< index into the effective lights; -1 = the frame has none; kEnvironmentLight
  const PlannedLight* planned{}; ///< of the plan; null where the light asks for no map
  std::size_t index = 0;         ///< of `planned` among the plan's lights
  const ShadowTile* tile{};      ///< of the plan: debug.tile; null where no view shows it
};

/// A problem at /debug/light where a frame of `lightCount` lights has none of that index.
Status checkDebugLight(const Debug& debug, std::size_t lightCount);

/// Refuses views of an atlas or a tile that the plan does not draw. The plan outlives the subject.
/// `layeredLights`: those whose shadow rays or shadow volumes find.
Result<DebugSubject> debugSubject(const FrameSpec& spec, const ShadowPlan& plan,
                                  std::span<const int> layeredLights = {});

/// The same, and all else that only a plan refuses: an atlas that takes more memory than a frame may have.
Result<DebugSubject> settlePlan(const FrameSpec& spec, const ShadowPlan& plan, std::span<const int> layeredLights);

} // namespace gnomon
