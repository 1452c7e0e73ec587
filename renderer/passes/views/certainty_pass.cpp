#include "renderer/passes/views/certainty_pass.h"

#include "renderer/gl/draw.h"
#include "renderer/gl/pipeline_state.h"
#include "renderer/gl/texture.h"
#include "renderer/passes/views/shadow_bindings.h"

namespace gnomon {

Result<std::vector<Verdict>> mapVerdicts(const PassInputs& inputs, const Shading& shading, const Surfaces& surfaces,
                                         int light) {
  const LitLight& lit = shading.lights[static_cast<std::size_t>(light)];
  if (lit.tileCount == 0 || shading.atlas.textures->outlines.id() == 0) return std::vector<Verdict>{};

  std::vector<std::string> defines{"SAMPLES " + std::to_string(surfaces.samplePositions.size())};
  if (lit.type != LightType::directional) defines.emplace_back("PUNCTUAL");
  if (inputs.receiverGroups) defines.emplace_back("RECEIVER_GROUPS");
  const auto program = inputs.programs.get({"fullscreen.vert", "certainty.frag", std::move(defines)});
  if (!program) return program.problems();

  const gl::Texture color({GL_R8, inputs.width, inputs.height}, "certainty");
  const auto target = gl::Framebuffer::create({{{&color}}, {}}, "certainty");
  if (!target) return target.problems();
  gl::PipelineState state;
  state.framebuffer = target->id();
  state.viewport = {0, 0, inputs.width, inputs.height};
  gl::apply(state);

  bindInputs(inputs);
  shading.buffers.lights.bindStorage(GNOMON_LIGHT_BUFFER);
  shading.buffers.tiles.bindStorage(GNOMON_TILE_BUFFER);
  const gl::Sampler texels({GL_NEAREST, GL_NEAREST}, "texels");
  bindTexture(depthOf(surfaces, shading.survey), texels, GNOMON_DEPTH_UNIT);
  bindTexture(surfaces.bits, texels, GNOMON_SURFACE_UNIT);
  bindTexture(shading.atlas.textures->depth, texels, GNOMON_ATLAS_UNIT);
  bindTexture(shading.atlas.textures->outlines, texels, GNOMON_OUTLINES_UNIT);
  (*program)->set(GNOMON_DEBUG_LIGHT, light);
  for (std::size_t i = 0; i < surfaces.samplePositions.size(); ++i) {
    (*program)->set(GNOMON_SAMPLE_POSITIONS + static_cast<GLint>(i), surfaces.samplePositions[i]);
  }
  const gl::VertexArray nothing({}, {}, nullptr, "fullscreen");
  gl::drawFullscreen(**program, nothing);
  std::vector<Verdict> verdicts(static_cast<std::size_t>(inputs.width) * static_cast<std::size_t>(inputs.height));
  target->readColor(0, {0, 0, inputs.width, inputs.height}, {GL_RED, GL_UNSIGNED_BYTE},
                    std::as_writable_bytes(std::span(verdicts)));
  return verdicts;
}

} // namespace gnomon
