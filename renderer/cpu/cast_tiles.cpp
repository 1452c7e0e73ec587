#include "renderer/cpu/cast_tiles.h"

#include <chrono>

#include "protocol/base/elapsed.h"
#include "renderer/cpu/camera_survey.h"
#include "renderer/cpu/material_holes.h"
#include "renderer/cpu/moments.h"

namespace gnomon::cpu {
namespace {

/// One an instance, by way of the scene's anchor: what stands still has the same matrix whatever the camera.
std::vector<glm::mat4> tileFromLocal(const FrameScene& scene, const ShadowTile& tile) {
  const glm::dvec3 anchor = anchorOf(scene.view);
  std::vector<glm::mat4> matrices;
  matrices.reserve(scene.view.instances.size());
  for (const Instance& instance : scene.view.instances) {
    glm::dmat4 anchoredFromLocal = instance.worldFromLocal;
    anchoredFromLocal[3] -= glm::dvec4(anchor, 0.0);
    matrices.emplace_back(tile.clipFromAnchored * anchoredFromLocal);
  }
  return matrices;
}

std::uint64_t rasterCasters(const CastInput& input, const ShadowTile& tile, const Light& light,
                            const TileCasters& casters, DepthBuffer& buffer) {
  const std::vector<glm::mat4> clip = tileFromLocal(input.scene, tile);
  const MaterialHoles holes({input.scene, input.textures, clip, glm::ivec2(tile.rect.width, tile.rect.height),
                             glm::ivec2(tile.rect.x, tile.rect.y),
                             light.shadow->blendedCasters == BlendedCasters::dither});
  const std::vector<RasterDraw> draws = rasterDraws(input.scene, casters.use, casters.slots);
  return raster({input.scene.scene, input.scene.slots, clip, draws, &holes}, DepthRange::clamped, buffer,
                input.scratch);
}

} // namespace

CastTiles castTiles(const CastInput& input, TileStore& store) {
  const std::vector<ShadowTile>& tiles = input.plan.tiles;
  const std::vector<const Light*> lightOf = lightsOfTiles(input.plan, *input.spec.lights);
  CastTiles cast;
  cast.tiles.resize(tiles.size());
  cast.facts.resize(tiles.size());
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    const ShadowTile& tile = tiles[i];
    if (tile.rect.width <= 0) continue;
    const auto start = std::chrono::steady_clock::now();
    const Light& light = *lightOf[i];
    const TileCasters casters = castersInto(tile, light, input.scene.view, input.scene.geometry, input.nodes);
    const int samples = input.spec.atlas.samples;
    const TileKey key = tileKey(input.sceneId, input.view, tile, light, casters, samples);
    TileFacts& facts = cast.facts[i];
    if ((cast.tiles[i] = store.find(key))) {
      facts.reused = true;
      continue;
    }
    auto made = std::make_shared<RasteredTile>();
    made->depths = emptyBuffer(tile.rect.width, tile.rect.height, samples, DepthRange::clamped, false);
    facts.casterTriangles = rasterCasters(input, tile, light, casters, made->depths);
    if (isBlurred(tile)) made->moments = blurredMoments(made->depths, momentBlur(tile));
    facts.culledTriangles = input.scene.view.triangles - facts.casterTriangles;
    store.keep(key, made);
    cast.tiles[i] = std::move(made);
    facts.time = WorkTime{millisecondsSince(start)};
  }
  return cast;
}

DepthBuffer numberedTile(const CastInput& input, const ShadowTile& tile, const Light& light) {
  DepthBuffer buffer = emptyBuffer(tile.rect.width, tile.rect.height, 1, DepthRange::clamped, true);
  const TileCasters casters = castersInto(tile, light, input.scene.view, input.scene.geometry, input.nodes);
  rasterCasters(input, tile, light, casters, buffer);
  return buffer;
}

} // namespace gnomon::cpu
