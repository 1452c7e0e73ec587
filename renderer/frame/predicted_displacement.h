#pragma once

#include <optional>
#include <span>
#include <vector>

#include "renderer/frame/draw_views.h"
#include "renderer/passes/views/displacement_pass.h"
#include "renderer/resolve/resolve_frame.h"
#include "renderer/shadow/shadow_plan.h"

namespace gnomon {

/// What EdgeDisplacement::mean of a shadow is expected to be, over its own edges.
struct PredictedDisplacement {
  double mean = 0;   ///< pixels
  double length = 0; ///< pixels: of the edges
};

/// Shadow edges of the picture `shown` (S at full strength, a value a pixel, first row on top) and the map under them,
/// for a light whose tiles these are. Absent where S has no edge.
std::optional<PredictedDisplacement> displacementOf(const CameraView& view, int width, int height,
                                                    std::span<const MapFootprint> footprints,
                                                    std::span<const float> shown, std::span<const ShadowTile> tiles,
                                                    int atlasSamples);

/// The same of a frame's debug light. Absent, too, where the frame doesn't ask, or no map makes that light's shadow.
Result<std::optional<PredictedDisplacement>> predictDisplacement(const PassInputs& inputs, const ViewInputs& shading,
                                                                 const ShadowPlan& plan, const DrawnViews& drawn);

} // namespace gnomon
