#include "renderer/passes/views/shadow_bindings.h"

namespace gnomon {

ShadowBindings::ShadowBindings(const ViewInputs& shading)
    : lights_(std::as_bytes(shading.lights), "lights"),
      tiles_(std::as_bytes(shading.tiles), "tiles"),
      texels_({GL_NEAREST, GL_NEAREST}, "shadow texels"),
      blurred_({GL_LINEAR, GL_LINEAR}, "shadow moments") {
  lights_.bindStorage(GNOMON_LIGHT_BUFFER);
  tiles_.bindStorage(GNOMON_TILE_BUFFER);
  bindTexture(shading.atlas.textures->depth, texels_, GNOMON_ATLAS_UNIT);
  bindTexture(shading.atlas.textures->moments, blurred_, GNOMON_MOMENTS_UNIT);
}

void bindTexture(const gl::Texture& texture, const gl::Sampler& sampler, GLuint unit) {
  if (texture.id() == 0) return;
  texture.bind(unit);
  sampler.bind(unit);
}

} // namespace gnomon
