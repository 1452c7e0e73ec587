#pragma once

#include <cstdint>

#include "protocol/base/result.h"
#include "renderer/device/device.h"
#include "renderer/gl/texture.h"
#include "renderer/gl/timer.h"
#include "renderer/passes/views/view_pass.h"

namespace gnomon {

/// What the scene hides of the frame's environment at each sample of the surfaces, found by the processor's rays.
/// REQUIRES: numbered surfaces.
Result<SkyTexture> skyTexture(const PassInputs& inputs, const Shading& shading, const FrameWork& work,
                              const Surfaces& surfaces);

} // namespace gnomon
