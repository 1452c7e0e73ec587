#pragma once

#include "protocol/base/result.h"
#include "renderer/gl/texture.h"
#include "renderer/passes/pass_inputs.h"

namespace gnomon {

/// The depths of an atlas that has several a texel, as R32F: of each texel the nearest to the light. What is drawn with
/// one a texel can be read as it is: an empty texture.
Result<gl::Texture> flattenAtlas(const PassInputs& inputs, const gl::Texture& depth);

} // namespace gnomon
