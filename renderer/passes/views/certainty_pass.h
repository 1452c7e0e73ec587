#pragma once

#include <cstdint>
#include <vector>

#include "renderer/passes/views/view_pass.h"

namespace gnomon {

/// What a shadow map knows of a pixel.
enum class Verdict : std::uint8_t {
  shadow = 0,
  turnedAway = 64, ///< in shadow, because the surface faces away from the light
  unsure = 128,
  lit = 255
};

/// The verdict of the map of light `light` (technique hybrid) on every pixel, row by row from the LOWEST row. Sure ones
/// are right for every sample of the pixel; shaders/certainty.frag says why. None where the light has no tile, or
/// nothing lies in one. Waits for the device.
Result<std::vector<Verdict>> mapVerdicts(const PassInputs& inputs, const ViewInputs& shading, const Surfaces& surfaces,
                                         int light);

} // namespace gnomon
