#pragma once

#include <span>
#include <vector>

#include "renderer/device/device.h"
#include "renderer/passes/views/view_pass.h"

namespace gnomon {

/// One a pixel, first row on top, of `shading.debugLight`. `surfaces`: one sample a pixel. Waits for the device.
/// REQUIRES: that light has tiles.
Result<std::vector<MapFootprint>> mapFootprints(const PassInputs& inputs, const Shading& shading,
                                                const Surfaces& surfaces);

/// The share of `shading.debugLight` that each point gets by this frame's tiles, 0..1, at any place of the view: what
/// the view `shadow` shows where a pixel's centre meets the point. Of `shading` the lights, the tiles and the atlas
/// count. REQUIRES: a debug light.
Result<std::vector<float>> probeShadow(const PassInputs& inputs, const Shading& shading,
                                       std::span<const ProbePoint> points);

} // namespace gnomon
