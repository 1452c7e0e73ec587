#pragma once

#include "renderer/passes/pass_inputs.h"
#include "renderer/passes/tiles/tile_cache.h"
#include "renderer/passes/tiles/tile_casters.h"

namespace gnomon {

/// The key of a tile as it will be drawn, `samples` depths a texel.
TileKey tileKey(const PassInputs& inputs, const ShadowTile& tile, const Light& light, const TileCasters& casters,
                int samples);

} // namespace gnomon
