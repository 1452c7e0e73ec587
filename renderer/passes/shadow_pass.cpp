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

/// The light that each tile is of.
std::vector<const Light*> lightsOfTiles(const ShadowPlan& plan, std::span<const Light> lights) {
  std::vector<const Light*> of(plan.tiles.size());
  for (const PlannedLight& planned : plan.lights) {
    std::fill_n(of.begin() + planned.firstTile, planned.tileCount, &lights[static_cast<std::size_t>(planned.light)]);
  }
  return of;
}

std::vector<std::uint8_t> castersOf(const PassInputs& inputs, const ShadowTile& tile, const Light& light) {
  const std::vector<Aabb>& bounds = inputs.geometry.slotBounds;
  std::vector<std::uint8_t> keep(bounds.size());
  std::transform(bounds.begin(), bounds.end(), keep.begin(),
                 [&](const Aabb& box) { return static_cast<std::uint8_t>(mayCastInto(tile, box)); });
  keepNodes(
      inputs, [&](const NodeSwitches& node) { return castsFrom(light, node); }, keep);
  return keep;
}

Status drawTile(const PassInputs& inputs, const ShadowTile& tile, const Light& light, const DrawBatch& batch,
                GLuint framebuffer) {
  gl::PipelineState state;
  state.framebuffer = framebuffer;
  state.viewport = tile.rect;
  state.scissor = tile.rect;
  state.depth = {true, true, GL_LESS};
  state.multisample = true;
  state.depthClamp = true; // casters between the light and its near plane are kept, flattened onto it
  return drawGroups(inputs, batch, state, [&](const DrawGroup&, const Material* masked) {
    auto program = inputs.programs.get(castProgram(masked, light.shadow->blendedCasters));
    if (program) (*program)->set(GNOMON_LIGHT_CLIP, glm::mat4(tile.clipFromRelative));
    return program;
  });
}

} // namespace

Result<ShadowAtlas> castShadows(const PassInputs& inputs, const ShadowPlan& plan, const FrameSpec& spec) {
  const int samples = spec.atlas.samples;
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
  const std::vector<const Light*> lightOf = lightsOfTiles(plan, *spec.lights);
  for (std::size_t i = 0; i < plan.tiles.size(); ++i) {
    const ShadowTile& tile = plan.tiles[i];
    if (tile.rect.width == 0) continue;
    const DrawUse use = tile.space.fit.perspective ? DrawUse::castFromPoint : DrawUse::cast;
    const DrawBatch batch = uploadDraws(
        buildDrawList(inputs.scene, inputs.view, inputs.geometry, use, castersOf(inputs, tile, *lightOf[i])));
    if (const Status drawn = drawTile(inputs, tile, *lightOf[i], batch, target->id()); !drawn) return drawn.problems();
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
