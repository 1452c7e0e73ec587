#include "renderer/passes/tiles/tile_draw.h"

namespace gnomon {

DrawBatch uploadCasters(const PassInputs& inputs, const TileCasters& casters) {
  return uploadDraws(buildDrawList(inputs.scene, inputs.view, inputs.geometry, casters.use, casters.slots));
}

Status drawTile(const PassInputs& inputs, const ShadowTile& tile, const DrawBatch& batch, GLuint framebuffer,
                const CastProgram& programOf) {
  gl::PipelineState state;
  state.framebuffer = framebuffer;
  state.viewport = tile.rect;
  state.scissor = tile.rect;
  state.depth = {true, true, GL_LESS};
  state.multisample = true;
  state.depthClamp = true; // casters between the light and its near plane are kept, flattened onto it
  return drawGroups(inputs, inputs.anchored, batch, state, [&](const DrawGroup&, const Material* masked) {
    auto program = inputs.programs.get(programOf(masked));
    if (program) (*program)->set(GNOMON_LIGHT_CLIP, glm::mat4(tile.clipFromAnchored));
    return program;
  });
}

} // namespace gnomon
