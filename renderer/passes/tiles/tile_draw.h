#pragma once

#include <functional>

#include "protocol/base/result.h"
#include "renderer/passes/pass_inputs.h"
#include "renderer/prepare/tile_casters.h"

namespace gnomon {

DrawBatch uploadCasters(const PassInputs& inputs, const TileCasters& casters);

/// The program that draws casters: of a masked material, or (null) of any opaque one.
using CastProgram = std::function<gl::ProgramSource(const Material* masked)>;

/// Draws casters into a tile's rectangle of `framebuffer`; the nearest to the light stays.
Status drawTile(const PassInputs& inputs, const ShadowTile& tile, const DrawBatch& batch, GLuint framebuffer,
                const CastProgram& programOf);

} // namespace gnomon
