#pragma once

#include "renderer/cpu/picture_layers.h"
#include "renderer/techniques/sky_shadow.h"

namespace gnomon::cpu {

/// What the scene hides of the frame's environment at each sample of `surfaces`, which are numbered.
Result<SkyShadow> skyLayer(const CameraRaster& camera, const FrameWork& work, const DepthBuffer& surfaces);

} // namespace gnomon::cpu
