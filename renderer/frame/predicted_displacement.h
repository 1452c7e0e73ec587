#pragma once

#include <optional>
#include <span>
#include <vector>

#include "renderer/device/device.h"
#include "renderer/resolve/resolve_frame.h"
#include "renderer/shadow/shadow_plan.h"

namespace gnomon {

/// What EdgeDisplacement::mean of a shadow is expected to be, over its own edges.
struct PredictedDisplacement {
  double mean = 0;   ///< pixels
  double length = 0; ///< pixels: of the edges
};

/// Whether a map alone makes the shadow of that light; false for -1, no light.
bool readsMap(std::span<const LitLight> lights, int light);

/// Shadow edges of the picture `shown` (S at full strength, a value a pixel, first row on top) and the map under them,
/// for the light `planned`. `spec`: effective. Absent where S has no edge.
std::optional<PredictedDisplacement> displacementOf(const CameraView& view, const FrameSpec& spec,
                                                    const ShadowPlan& plan, const PlannedLight& planned,
                                                    std::span<const MapFootprint> footprints,
                                                    std::span<const float> shown);

} // namespace gnomon
