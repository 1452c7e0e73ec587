#include "renderer/passes/views/shadow_bindings.h"

namespace gnomon {

ShadowBindings::ShadowBindings(const Shading& shading)
    : texels_({GL_NEAREST, GL_NEAREST}, "shadow texels"), blurred_({GL_LINEAR, GL_LINEAR}, "shadow moments") {
  shading.buffers.lights.bindStorage(GNOMON_LIGHT_BUFFER);
  shading.buffers.tiles.bindStorage(GNOMON_TILE_BUFFER);
  bindTexture(shading.atlas.textures->depth, texels_, GNOMON_ATLAS_UNIT);
  bindTexture(shading.atlas.textures->moments, blurred_, GNOMON_MOMENTS_UNIT);
}

void bindTexture(const gl::Texture& texture, const gl::Sampler& sampler, GLuint unit) {
  if (texture.id() == 0) return;
  texture.bind(unit);
  sampler.bind(unit);
}

} // namespace gnomon
