#pragma once

#include "protocol/result.h"
#include "renderer/gl/texture.h"
#include "renderer/gl/timer.h"
#include "renderer/passes/pass_inputs.h"
#include "renderer/shadow/shadow_plan.h"

namespace gnomon {

/// What was drawn into one tile.
struct TileCounts {
  std::uint64_t casterTriangles = 0;
  std::uint64_t culledTriangles = 0;
  std::size_t drawCalls = 0;
  gl::Timer timer; ///< of finding the casters and drawing them; of the first tile, of clearing the atlas too
};

/// Every light's tiles, drawn.
struct ShadowAtlas {
  gl::Texture depth;             ///< D32F, 0 nearest the light; 1 where nothing casts. Empty for an empty plan
  gl::Texture moments;           ///< RGBA32F, of the tiles whose filter blurs; empty where none does
  std::vector<TileCounts> tiles; ///< one a tile of the plan
  std::size_t drawCalls = 0;
  gl::Timer timer; ///< of all tiles
};

/// `samples` depths a texel: 1 or 4.
Result<ShadowAtlas> castShadows(const PassInputs& inputs, const ShadowPlan& plan, int samples);

} // namespace gnomon
