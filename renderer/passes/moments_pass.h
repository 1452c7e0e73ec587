#pragma once

#include "protocol/result.h"
#include "renderer/gl/texture.h"
#include "renderer/passes/pass_inputs.h"
#include "renderer/shadow/shadow_plan.h"

namespace gnomon {

/// The moments of the depths of every tile whose filter blurs, at the tile's own place; RGBA32F. Empty where no tile
/// does. No blur reads beside its tile.
Result<gl::Texture> blurMoments(const PassInputs& inputs, const ShadowPlan& plan, const gl::Texture& depth);

} // namespace gnomon
