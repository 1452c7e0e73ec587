#pragma once

#include <span>

#include "protocol/base/result.h"
#include "protocol/spec/scene_options.h"
#include "renderer/gl/texture.h"
#include "renderer/passes/pass_inputs.h"
#include "renderer/shadow/shadow_plan.h"

namespace gnomon {

/// The depths of an atlas that has several a texel, as R32F: of each texel the nearest to the light. What is drawn with
/// one a texel can be read as it is: an empty texture.
Result<gl::Texture> flattenAtlas(const PassInputs& inputs, const gl::Texture& depth);

/// Which node stands nearest to a light, texel by texel. As large as the atlas, with the light's tiles in their places.
struct CasterNodes {
  gl::Texture nodes; ///< R32I: the node's index; -1 where nothing casts. Empty where the light has no tiles
  gl::Texture depth; ///< D32F: that node's depth, as in the atlas
  std::size_t drawCalls = 0;

  std::size_t bytes() const { return nodes.bytes() + depth.bytes(); } ///< on the device
};

/// Draws the casters of one light once more; `planned` is one of the plan's, or null for none. `lights`: effective.
Result<CasterNodes> drawCasterNodes(const PassInputs& inputs, const ShadowPlan& plan, const PlannedLight* planned,
                                    std::span<const Light> lights);

} // namespace gnomon
