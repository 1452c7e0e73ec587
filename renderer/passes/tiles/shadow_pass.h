#pragma once

#include "protocol/base/result.h"
#include "protocol/spec/frame_spec.h"
#include "renderer/gl/timer.h"
#include "renderer/passes/pass_inputs.h"
#include "renderer/passes/tiles/tile_cache.h"
#include "renderer/shadow/shadow_plan.h"

namespace gnomon {

/// What was drawn into one tile.
struct TileCounts {
  std::uint64_t casterTriangles = 0;
  std::uint64_t culledTriangles = 0;
  std::size_t drawCalls = 0;
  bool reused = false; ///< an earlier frame's tile serves; nothing was drawn
  gl::Timer timer;     ///< of drawing; the first tile's brings finding all casters and clearing the atlas
};

/// Every light's tiles, drawn.
struct ShadowAtlas {
  std::shared_ptr<const AtlasTextures> textures = std::make_shared<AtlasTextures>(); ///< without any for an empty plan
  std::vector<TileCounts> tiles;                                                     ///< one a tile of the plan
  std::size_t drawCalls = 0;
  gl::Timer timer; ///< of all tiles
};

/// `spec`: effective. Tiles that the cache has are taken from it, and the cache keeps the new ones.
Result<ShadowAtlas> castShadows(const PassInputs& inputs, const ShadowPlan& plan, const FrameSpec& spec,
                                TileCache& cache);

} // namespace gnomon
