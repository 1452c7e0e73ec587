#include "renderer/passes/tiles/shadow_pass.h"

#include <algorithm>
#include <glm/gtc/type_ptr.hpp>
#include <utility>

#include "protocol/spec/traits.h"
#include "renderer/device/shader_data.h"
#include "renderer/gl/draw.h"
#include "renderer/gl/framebuffer.h"
#include "renderer/gl/pipeline_state.h"
#include "renderer/gl/texture.h"
#include "renderer/passes/shader_variants.h"

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

/// Texels to each side that the blur takes whole: (x, y).
glm::vec2 blurOf(const ShadowTile& tile) {
  if (tile.filter.radius <= 0) return glm::vec2(0.5f * static_cast<float>(tile.filter.size - 1));
  const glm::dvec2 texels = tile.space.fit.radius / tile.space.fit.texelSize;
  return glm::vec2(glm::max(glm::dvec2(0.0), texels - 0.5));
}

struct Step {
  bool alongX = true;
  const gl::Texture& from;
  const gl::Framebuffer& to;
  Rect viewport;
};

Status blur(const PassInputs& inputs, const ShadowTile& tile, int samples, const Step& step) {
  std::vector<std::string> defines{"FILTER_KIND " + std::to_string(filterKind(tile.filter))};
  if (step.alongX) defines.emplace_back("ALONG_X");
  if (step.alongX && samples > 1) defines.push_back("ATLAS_SAMPLES " + std::to_string(samples));
  const auto program = inputs.programs.get({"fullscreen.vert", "moments.frag", std::move(defines)});
  if (!program) return program.problems();
  const glm::vec2 texels = blurOf(tile);
  const bool perspective = tile.space.fit.perspective;
  (*program)->set(GNOMON_MOMENT_TILE, glm::ivec4(tile.rect.x, tile.rect.y, tile.rect.width, tile.rect.height));
  (*program)->set(GNOMON_MOMENT_BLUR, glm::vec4(step.alongX ? texels.x : texels.y, perspective ? tile.near : 0.0,
                                                perspective ? tile.far : 0.0, 0.0));
  gl::drawBands(**program, {.framebuffer = step.to.id(), .viewport = step.viewport, .scissor = step.viewport},
                {{0, &step.from}});
  return Done{};
}

/// Makes the moments of the depths of these tiles, each at its own place. No blur reads beside its tile.
Status blurMoments(const PassInputs& inputs, const std::vector<const ShadowTile*>& tiles, AtlasTextures& atlas) {
  int side = 0;
  for (const ShadowTile* tile : tiles) side = std::max(side, tile->rect.width);
  if (side == 0) return Done{};
  const gl::Texture rows({GL_RGBA32F, side, side}, "blurred rows");
  auto target = gl::Framebuffer::create({{{&atlas.moments}}, {}}, "shadow moments");
  if (!target) return target.problems();
  auto between = gl::Framebuffer::create({{{&rows}}, {}}, "blurred rows");
  if (!between) return between.problems();
  const int samples = std::max(1, atlas.depth.shape().samples);
  for (const ShadowTile* tile : tiles) {
    const Rect alone{0, 0, tile->rect.width, tile->rect.height};
    if (Status along = blur(inputs, *tile, samples, {true, atlas.depth, *between, alone}); !along) return along;
    if (Status up = blur(inputs, *tile, samples, {false, rows, *target, tile->rect}); !up) return up;
  }
  return Done{};
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

std::size_t AtlasTextures::bytes() const {
  return depth.bytes() + moments.bytes();
}

std::shared_ptr<const AtlasTextures> TileCache::findAll(std::span<const TileKey> keys) {
  const Entry* const found = entries_.findIf([&](const Entry& entry) {
    return std::all_of(keys.begin(), keys.end(), [&](const TileKey& key) {
      return std::binary_search(entry.keys.begin(), entry.keys.end(), key);
    });
  });
  return found ? found->textures : nullptr;
}

std::shared_ptr<const AtlasTextures> TileCache::find(const TileKey& key) {
  return findAll(std::span(&key, 1));
}

void TileCache::keep(std::vector<TileKey> keys, std::shared_ptr<const AtlasTextures> textures) {
  if (textures->bytes() > budgetBytes_) return;
  std::sort(keys.begin(), keys.end());
  // What the new atlas holds as well is nothing worth.
  entries_.eraseIf([&](const Entry& entry) {
    return std::includes(keys.begin(), keys.end(), entry.keys.begin(), entry.keys.end());
  });
  entries_.add({std::move(keys), std::move(textures)});
  entries_.keepWithin(budgetBytes_, [](const Entry& entry) { return entry.textures->bytes(); });
}

} // namespace gnomon
