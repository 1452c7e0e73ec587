#pragma once

#include <functional>

#include "protocol/result.h"
#include "renderer/gl/texture.h"
#include "renderer/passes/pass_inputs.h"
#include "renderer/shadow/shadow_plan.h"

namespace gnomon {

/// The draws of everything that may throw a shadow into a tile.
DrawBatch castersInto(const PassInputs& inputs, const ShadowTile& tile);

/// The program that draws casters: of a masked material, or (null) of any opaque one.
using CastProgram = std::function<gl::ProgramSource(const Material* masked)>;

/// Draws casters into a tile's rectangle of `framebuffer`; the nearest to the light stays.
Status drawTile(const PassInputs& inputs, const ShadowTile& tile, const DrawBatch& batch, GLuint framebuffer,
                const CastProgram& programOf);

/// What was drawn into one tile.
struct TileCounts {
  std::uint64_t casterTriangles = 0;
  std::uint64_t culledTriangles = 0;
};

/// Every light's tiles, drawn.
struct ShadowAtlas {
  gl::Texture depth;             ///< D32F, 0 nearest the light; 1 where nothing casts. Empty for an empty plan
  gl::Texture moments;           ///< RGBA32F, of the tiles whose filter blurs; empty where none does
  std::vector<TileCounts> tiles; ///< one a tile of the plan
  std::size_t drawCalls = 0;
};

/// `samples` depths a texel: 1 or 4.
Result<ShadowAtlas> castShadows(const PassInputs& inputs, const ShadowPlan& plan, int samples);

} // namespace gnomon
