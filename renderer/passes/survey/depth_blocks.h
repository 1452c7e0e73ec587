#pragma once

#include "protocol/base/result.h"
#include "renderer/gl/texture.h"
#include "renderer/passes/pass_inputs.h"
#include "renderer/shadow/shadow_plan.h"

namespace gnomon {

/// Reduces a reversed depth buffer of the frame (`samples` a pixel: 1 or 4) to what each block of pixels shows.
Result<ReceiverDepths> depthBlocks(const PassInputs& inputs, const gl::Texture& depth, int samples);

/// The view depth in metres of a reversed depth value.
double viewDepthOf(const CameraView& camera, double depth);

} // namespace gnomon
