#pragma once

#include "renderer/gl/texture.h"
#include "renderer/passes/views/view_pass.h"

namespace gnomon {

/// Lights, tiles and the atlas, bound for a shader that looks shadows up (shaders/common_shadow.glsl). Lives as long as
/// that is drawn.
class ShadowBindings {
 public:
  explicit ShadowBindings(const Shading& shading);

 private:
  gl::Sampler texels_;
  gl::Sampler blurred_;
};

/// Binds nothing where the texture is empty.
void bindTexture(const gl::Texture& texture, const gl::Sampler& sampler, GLuint unit);

} // namespace gnomon
