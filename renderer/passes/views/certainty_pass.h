#pragma once

#include <vector>

#include "renderer/passes/views/view_pass.h"
#include "renderer/techniques/traced_shadow.h"

namespace gnomon {

/// The verdict of the map of light `light` (technique hybrid) on every pixel, row by row from the LOWEST row. Sure ones
/// are right for every sample of the pixel; shaders/certainty.frag says why. None where the light has no tile, or
/// nothing lies in one. Waits for the device.
Result<std::vector<Verdict>> mapVerdicts(const PassInputs& inputs, const Shading& shading, const Surfaces& surfaces,
                                         int light);

} // namespace gnomon
