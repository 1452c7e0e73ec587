#include "renderer/passes/tiles/atlas_depth_pass.h"

#include "renderer/gl/draw.h"
#include "renderer/gl/framebuffer.h"
#include "renderer/gl/pipeline_state.h"
#include "renderer/gl/texture.h"

namespace gnomon {

Result<gl::Texture> flattenAtlas(const PassInputs& inputs, const gl::Texture& depth) {
  const gl::TextureShape& shape = depth.shape();
  if (shape.samples == 0) return gl::Texture();
  const auto program =
      inputs.programs.get({"fullscreen.vert", "atlas_depth.frag", {"SAMPLES " + std::to_string(shape.samples)}});
  if (!program) return program.problems();
  gl::Texture flat({GL_R32F, shape.width, shape.height}, "flat atlas");
  auto target = gl::Framebuffer::create({{{&flat}}, {}}, "flat atlas");
  if (!target) return target.problems();

  gl::PipelineState state;
  state.framebuffer = target->id();
  state.viewport = {0, 0, shape.width, shape.height};
  gl::apply(state);
  const gl::Sampler texels({GL_NEAREST, GL_NEAREST}, "flat atlas");
  depth.bind(GNOMON_ATLAS_UNIT);
  texels.bind(GNOMON_ATLAS_UNIT);
  const gl::VertexArray nothing({}, {}, nullptr, "fullscreen");
  gl::drawFullscreen(**program, nothing);
  return flat;
}

} // namespace gnomon
