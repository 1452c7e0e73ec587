#pragma once

#include <vector>

#include "renderer/device/device.h"
#include "renderer/passes/views/view_pass.h"

namespace gnomon {

/// One a pixel, first row on top, of `shading.debugLight`. `surfaces`: one sample a pixel. Waits for the device.
/// REQUIRES: that light has tiles.
Result<std::vector<MapFootprint>> mapFootprints(const PassInputs& inputs, const Shading& shading,
                                                const Surfaces& surfaces);

} // namespace gnomon
