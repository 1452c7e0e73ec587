#pragma once

#include <vector>

#include "protocol/base/result.h"
#include "renderer/passes/pass_inputs.h"
#include "renderer/passes/tiles/tile_cache.h"
#include "renderer/shadow/shadow_plan.h"

namespace gnomon {

/// Makes the moments of the depths of these tiles, each at its own place. No blur reads beside its tile.
Status blurMoments(const PassInputs& inputs, const std::vector<const ShadowTile*>& tiles, AtlasTextures& atlas);

} // namespace gnomon
