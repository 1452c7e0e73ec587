#include "renderer/passes/tiles/shadow_pass.h"

#include <algorithm>
#include <utility>

#include "protocol/spec/traits.h"
#include "renderer/gl/draw.h"
#include "renderer/gl/framebuffer.h"
#include "renderer/gl/pipeline_state.h"
#include "renderer/passes/pass_inputs.h"
#include "renderer/passes/shader_variants.h"
#include "renderer/passes/tiles/moments_pass.h"

namespace gnomon {
namespace {

/// A tile that has texels, and what goes into it.
struct TileContent {
  std::size_t index = 0; ///< into the plan's tiles
  const Light& light;
  TileCasters casters;
};

std::vector<TileContent> contentsOf(const PassInputs& inputs, const ShadowPlan& plan, const FrameSpec& spec) {
  const std::vector<const Light*> lightOf = lightsOfTiles(plan, *spec.lights);
  std::vector<TileContent> contents;
  for (std::size_t i = 0; i < plan.tiles.size(); ++i) {
    const ShadowTile& tile = plan.tiles[i];
    if (tile.rect.width <= 0) continue;
    contents.push_back({i, *lightOf[i], castersInto(tile, *lightOf[i], inputs.view, inputs.geometry, inputs.nodes)});
  }
  return contents;
}

/// An empty atlas of the plan's size; a framebuffer over it is to be cleared.
AtlasTextures emptyAtlas(const ShadowPlan& plan, int samples) {
  AtlasTextures textures;
  textures.depth = gl::Texture({GL_DEPTH_COMPONENT32F, plan.atlasWidth, plan.atlasHeight, 1, samples > 1 ? samples : 0},
                               "shadow atlas");
  const bool blurs = std::any_of(plan.tiles.begin(), plan.tiles.end(), isBlurred);
  if (blurs) textures.moments = gl::Texture({GL_RGBA32F, plan.atlasWidth, plan.atlasHeight}, "shadow moments");
  return textures;
}

void clearDepths(const gl::Texture& depth, gl::Framebuffer& target) {
  gl::PipelineState whole;
  whole.framebuffer = target.id();
  whole.viewport = {0, 0, depth.width(), depth.height()};
  whole.depth = {true, true, GL_LESS};
  gl::apply(whole);
  target.clearDepth(1.0f);
}

} // namespace

Result<ShadowAtlas> castShadows(const PassInputs& inputs, const ShadowPlan& plan, const FrameSpec& spec,
                                TileCache& cache) {
  ShadowAtlas atlas;
  atlas.tiles.resize(plan.tiles.size());
  if (plan.atlasWidth == 0) return atlas;
  atlas.timer = gl::Timer::start();
  gl::Timer timer = gl::Timer::start(); // of the first tile: it brings the clear
  const std::vector<TileContent> contents = contentsOf(inputs, plan, spec);
  std::vector<TileKey> keys;
  keys.reserve(contents.size());
  const int view = static_cast<int>(&inputs.view - inputs.scene.scenes.data());
  for (const TileContent& content : contents) {
    keys.push_back(
        tileKey(inputs.gpu.id, view, plan.tiles[content.index], content.light, content.casters, spec.atlas.samples));
  }

  if (auto same = cache.findAll(keys);
      same && same->depth.width() == plan.atlasWidth && same->depth.height() == plan.atlasHeight) {
    for (const TileContent& content : contents) atlas.tiles[content.index].reused = true;
    atlas.textures = std::move(same);
    atlas.timer.stop();
    return atlas;
  }

  auto textures = std::make_shared<AtlasTextures>(emptyAtlas(plan, spec.atlas.samples));
  auto target = gl::Framebuffer::create({{}, {&textures->depth}}, "shadow atlas");
  if (!target) return target.problems();
  clearDepths(textures->depth, *target);
  bindInputs(inputs);
  std::vector<const ShadowTile*> toBlur;
  for (std::size_t i = 0; i < contents.size(); ++i) {
    const TileContent& content = contents[i];
    const ShadowTile& tile = plan.tiles[content.index];
    TileCounts& counts = atlas.tiles[content.index];
    if (const auto kept = cache.find(keys[i])) {
      textures->depth.copyFrom(kept->depth, tile.rect);
      if (isBlurred(tile)) textures->moments.copyFrom(kept->moments, tile.rect);
      counts.reused = true;
      continue;
    }
    const DrawBatch batch = uploadCasters(inputs, content.casters);
    const BlendedCasters blended = content.light.shadow->blendedCasters;
    const Status drawn = drawTile(inputs, tile, batch, target->id(),
                                  [&](const Material* masked) { return castProgram(masked, blended); });
    if (!drawn) return drawn.problems();
    timer.stop();
    gl::Timer next = gl::Timer::start(); // before the tile is submitted: see Timer
    gl::submit();                        // a software driver fills this tile while the next one is prepared
    counts = {batch.triangles, inputs.view.triangles - batch.triangles, batch.drawCalls, false,
              std::exchange(timer, std::move(next))};
    atlas.drawCalls += batch.drawCalls;
    if (isBlurred(tile)) toBlur.push_back(&tile);
  }
  if (const Status blurred = blurMoments(inputs, toBlur, *textures); !blurred) return blurred.problems();
  cache.keep(std::move(keys), textures);
  atlas.textures = std::move(textures);
  atlas.timer.stop();
  return atlas;
}

} // namespace gnomon
