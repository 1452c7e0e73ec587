#include "renderer/passes/shadow_pass.h"

#include <algorithm>

#include "renderer/gl/draw.h"
#include "renderer/gl/framebuffer.h"
#include "renderer/gl/pipeline_state.h"
#include "renderer/passes/draw_batch.h"
#include "renderer/passes/moments_pass.h"
#include "renderer/passes/shader_variants.h"

namespace gnomon {
namespace {

std::vector<std::uint8_t> castersOf(const ShadowTile& tile, const FrameGeometry& geometry) {
  std::vector<std::uint8_t> keep(geometry.slotCount());
  std::transform(geometry.slotBounds.begin(), geometry.slotBounds.end(), keep.begin(),
                 [&](const Aabb& box) { return static_cast<std::uint8_t>(mayCastInto(tile, box)); });
  return keep;
}

} // namespace

DrawBatch castersInto(const PassInputs& inputs, const ShadowTile& tile) {
  const DrawUse use = tile.space.fit.perspective ? DrawUse::castFromPoint : DrawUse::cast;
  return uploadDraws(buildDrawList(inputs.scene, inputs.view, inputs.geometry, use, castersOf(tile, inputs.geometry)));
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
  return drawGroups(inputs, batch, state, [&](const DrawGroup&, const Material* masked) {
    auto program = inputs.programs.get(programOf(masked));
    if (program) (*program)->set(GNOMON_LIGHT_CLIP, glm::mat4(tile.clipFromRelative));
    return program;
  });
}

Result<ShadowAtlas> castShadows(const PassInputs& inputs, const ShadowPlan& plan, int samples) {
  ShadowAtlas atlas;
  atlas.tiles.resize(plan.tiles.size());
  if (plan.atlasWidth == 0) return atlas;
  atlas.depth = gl::Texture({GL_DEPTH_COMPONENT32F, plan.atlasWidth, plan.atlasHeight, 1, samples > 1 ? samples : 0},
                            "shadow atlas");
  auto target = gl::Framebuffer::create({{}, {&atlas.depth}}, "shadow atlas");
  if (!target) return target.problems();

  gl::PipelineState whole;
  whole.framebuffer = target->id();
  whole.viewport = {0, 0, plan.atlasWidth, plan.atlasHeight};
  whole.depth = {true, true, GL_LESS};
  gl::apply(whole);
  target->clearDepth(1.0f);

  bindInputs(inputs);
  for (std::size_t i = 0; i < plan.tiles.size(); ++i) {
    const ShadowTile& tile = plan.tiles[i];
    if (tile.rect.width == 0) continue;
    const DrawBatch batch = castersInto(inputs, tile);
    const Status drawn = drawTile(inputs, tile, batch, target->id(), castProgram);
    if (!drawn) return drawn.problems();
    gl::submit(); // a software driver fills this tile while the next one is prepared
    atlas.tiles[i] = {batch.triangles, inputs.view.triangles - batch.triangles};
    atlas.drawCalls += batch.drawCalls;
  }
  auto moments = blurMoments(inputs, plan, atlas.depth);
  if (!moments) return moments.problems();
  atlas.moments = std::move(*moments);
  return atlas;
}

} // namespace gnomon
