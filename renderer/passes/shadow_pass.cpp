#include "renderer/passes/shadow_pass.h"

#include <utility>

#include "renderer/gl/draw.h"
#include "renderer/gl/framebuffer.h"
#include "renderer/gl/pipeline_state.h"
#include "renderer/passes/draw_batch.h"
#include "renderer/passes/moments_pass.h"
#include "renderer/passes/shader_variants.h"
#include "renderer/passes/tile_casters.h"

namespace gnomon {
namespace {

Status drawTile(const PassInputs& inputs, const ShadowTile& tile, const DrawBatch& batch, GLuint framebuffer) {
  gl::PipelineState state;
  state.framebuffer = framebuffer;
  state.viewport = tile.rect;
  state.scissor = tile.rect;
  state.depth = {true, true, GL_LESS};
  state.multisample = true;
  state.depthClamp = true; // casters between the light and its near plane are kept, flattened onto it
  return drawGroups(inputs, batch, state, [&](const DrawGroup&, const Material* masked) {
    auto program = inputs.programs.get(depthProgram("shadow_cast.vert", masked));
    if (program) (*program)->set(GNOMON_LIGHT_CLIP, glm::mat4(tile.clipFromRelative));
    return program;
  });
}

} // namespace

Result<ShadowAtlas> castShadows(const PassInputs& inputs, const ShadowPlan& plan, int samples) {
  ShadowAtlas atlas;
  atlas.tiles.resize(plan.tiles.size());
  if (plan.atlasWidth == 0) return atlas;
  atlas.timer = gl::Timer::start();
  gl::Timer timer = gl::Timer::start(); // of the first tile: it brings the clear
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
    const DrawBatch batch = uploadDraws(castersInto(tile, inputs.scene, inputs.view, inputs.geometry));
    if (const Status drawn = drawTile(inputs, tile, batch, target->id()); !drawn) return drawn.problems();
    timer.stop();
    gl::Timer next = gl::Timer::start(); // before the tile is submitted: see Timer
    gl::submit();                        // a software driver fills this tile while the next one is prepared
    atlas.tiles[i] = {batch.triangles, inputs.view.triangles - batch.triangles, batch.drawCalls,
                      std::exchange(timer, std::move(next))};
    atlas.drawCalls += batch.drawCalls;
  }
  auto moments = blurMoments(inputs, plan, atlas.depth);
  if (!moments) return moments.problems();
  atlas.moments = std::move(*moments);
  atlas.timer.stop();
  return atlas;
}

} // namespace gnomon
