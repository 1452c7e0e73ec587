#include "renderer/passes/tiles/atlas_views.h"

#include "renderer/gl/framebuffer.h"
#include "renderer/gl/pipeline_state.h"
#include "renderer/gl/texture.h"
#include "renderer/passes/pass_inputs.h"
#include "renderer/passes/shader_variants.h"

namespace gnomon {

Result<gl::Texture> flattenAtlas(const PassInputs& inputs, const gl::Texture& depth) {
  const gl::TextureShape& shape = depth.shape();
  if (shape.samples == 0) return gl::Texture();
  return drawTexture(inputs.programs, "atlas_depth.frag", depth, GNOMON_ATLAS_UNIT, GL_R32F);
}

Result<CasterNodes> drawCasterNodes(const PassInputs& inputs, const ShadowPlan& plan, const PlannedLight* planned,
                                    std::span<const Light> lights) {
  CasterNodes casters;
  if (planned == nullptr || planned->tileCount == 0) return casters;
  const Light& light = lights[static_cast<std::size_t>(planned->light)];
  casters.nodes = gl::Texture({GL_R32I, plan.atlasWidth, plan.atlasHeight}, "caster nodes");
  casters.depth = gl::Texture({GL_DEPTH_COMPONENT32F, plan.atlasWidth, plan.atlasHeight}, "caster depth");
  auto target = gl::Framebuffer::create({{{&casters.nodes}}, {&casters.depth}}, "caster nodes");
  if (!target) return target.problems();

  gl::PipelineState whole;
  whole.framebuffer = target->id();
  whole.viewport = {0, 0, plan.atlasWidth, plan.atlasHeight};
  whole.depth = {true, true, GL_LESS};
  gl::apply(whole);
  target->clearColor(0, glm::ivec4(-1));
  target->clearDepth(1.0f);

  bindInputs(inputs);
  for (int i = 0; i < planned->tileCount; ++i) {
    const ShadowTile& tile = plan.tiles[static_cast<std::size_t>(planned->firstTile + i)];
    if (tile.rect.width == 0) continue;
    const DrawBatch batch = uploadCasters(inputs, castersInto(tile, light, inputs.view, inputs.geometry, inputs.nodes));
    const Status drawn = drawTile(inputs, tile, batch, target->id(), [&](const Material* masked) {
      return casterNodeProgram(masked, light.shadow->blendedCasters);
    });
    if (!drawn) return drawn.problems();
    casters.drawCalls += batch.drawCalls;
  }
  return casters;
}

} // namespace gnomon
