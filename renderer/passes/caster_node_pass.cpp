#include "renderer/passes/caster_node_pass.h"

#include "renderer/gl/framebuffer.h"
#include "renderer/passes/shader_variants.h"
#include "renderer/passes/shadow_pass.h"

namespace gnomon {

Result<CasterNodes> drawCasterNodes(const PassInputs& inputs, const ShadowPlan& plan, const PlannedLight* light) {
  CasterNodes casters;
  if (light == nullptr || light->tileCount == 0) return casters;
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
  for (int i = 0; i < light->tileCount; ++i) {
    const ShadowTile& tile = plan.tiles[static_cast<std::size_t>(light->firstTile + i)];
    if (tile.rect.width == 0) continue;
    const DrawBatch batch = castersInto(inputs, tile);
    const Status drawn = drawTile(inputs, tile, batch, target->id(), casterNodeProgram);
    if (!drawn) return drawn.problems();
    casters.drawCalls += batch.drawCalls;
  }
  return casters;
}

} // namespace gnomon
