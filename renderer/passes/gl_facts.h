#pragma once

#include "renderer/device/facts.h"
#include "renderer/passes/views/draw_views.h"

namespace gnomon {

/// What the passes of a frame returned.
struct PassResults {
  const Survey& survey;
  const ShadowAtlas& atlas;
  const DrawnViews& drawn;
  const GpuScene& gpu;
  std::span<const ViewRequest> views; ///< that were shown
};

/// What they say of the frame, but for its stages. Reads the timers, so that it waits for the device if that is not
/// done.
FrameFacts factsOf(const PassResults& results);

} // namespace gnomon
