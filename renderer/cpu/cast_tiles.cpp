#include "renderer/cpu/cast_tiles.h"

#include <algorithm>
#include <chrono>

#include "protocol/base/elapsed.h"
#include "renderer/cpu/camera_survey.h"
#include "renderer/cpu/shadow/moments.h"
#include "renderer/cpu/surface/material_holes.h"
#include "renderer/device/shader_data.h"
#include "renderer/device/view_image.h"
#include "renderer/prepare/named_tiles.h"

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

std::uint64_t trianglesOf(const FrameScene& scene, std::span<const RasterDraw> draws) {
  std::uint64_t triangles = 0;
  for (const RasterDraw& draw : draws) triangles += scene.slots[draw.slot].triangles;
  return triangles;
}

/// The draws that may touch texels of `wanted`.
std::vector<RasterDraw> drawsInto(const CastInput& input, const ShadowTile& tile, const TexelMarks& wanted,
                                  std::vector<RasterDraw> draws) {
  const auto misses = [&](const RasterDraw& draw) {
    const Aabb clip = clipBox(tile.space, lightSpaceBox(tile.space, input.scene.geometry.slotBounds[draw.slot]));
    if (clip.empty()) return false;
    const auto texel = [](double at, int size) {
      return static_cast<int>(std::clamp((at * 0.5 + 0.5) * size, -2.0, size + 2.0));
    };
    // Corners are rounded as they are rastered, by far less than a texel.
    return !wanted.any(texel(clip.min.x, tile.rect.width) - 1, texel(clip.min.y, tile.rect.height) - 1,
                       texel(clip.max.x, tile.rect.width) + 1, texel(clip.max.y, tile.rect.height) + 1);
  };
  std::erase_if(draws, misses);
  return draws;
}

/// `only`: as RasterInput's; the buffer may hold anything.
void rasterCasters(const CastInput& input, const ShadowTile& tile, const Light& light,
                   std::span<const RasterDraw> draws, const TexelMarks* only, DepthBuffer& buffer) {
  const std::vector<glm::mat4> clip = tileFromLocal(input.scene, tile);
  const MaterialHoles holes({input.scene, input.textures, clip, glm::ivec2(tile.rect.width, tile.rect.height),
                             glm::ivec2(tile.rect.x, tile.rect.y), true,
                             light.shadow->blendedCasters == BlendedCasters::dither});
  raster({input.scene.scene, input.scene.slots, clip, draws, &holes, only, true}, DepthRange::clamped, buffer,
         input.scratch);
}

/// What goes into a tile that no earlier frame has left.
void addCasters(const CastInput& input, std::span<const RasterDraw> draws, TileFacts& facts) {
  facts.casterTriangles = trianglesOf(input.scene, draws);
  facts.culledTriangles = input.scene.view.triangles - facts.casterTriangles;
}

void addTime(TileFacts& facts, double milliseconds) {
  facts.time = WorkTime{(facts.time ? facts.time->cpuMilliseconds : 0.0) + milliseconds};
}

/// Of a tile that has no texels yet.
RasteredTile emptyTile(const ShadowTile& tile, int samples, TileStore& store) {
  const int width = tile.rect.width, height = tile.rect.height;
  RasteredTile storage = store.room(DepthBuffer{width, height, samples}.places() * sizeof(float));
  RasteredTile made;
  made.depths = unfilledBuffer(width, height, samples, false, std::move(storage.depths));
  made.made = TexelMarks(width, height);
  if (!isBlurred(tile)) return made;
  made.moments = std::move(storage.moments);
  made.moments.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  made.blurred = TexelMarks(width, height);
  return made;
}

std::vector<TileMap> tileMaps(const ShadowPlan& plan, const CastTiles& cast) {
  std::vector<TileMap> maps;
  for (std::size_t i = 0; i < plan.tiles.size(); ++i) {
    const RasteredTile* tile = cast.tiles[i].get();
    maps.push_back({plan.tiles[i].rect, tile ? &tile->depths : nullptr,
                    tile ? std::span<const glm::vec4>(tile->moments) : std::span<const glm::vec4>{}});
  }
  return maps;
}

/// The nearest depth of each texel, put into the atlas row by row from the bottom.
void addDepths(const ShadowTile& tile, const DepthBuffer& depths, const Rect& of, std::vector<float>& out) {
  for (int y = 0; y < tile.rect.height; ++y) {
    for (int x = 0; x < tile.rect.width; ++x) {
      float nearest = 1;
      for (int s = 0; s < depths.samples; ++s) nearest = std::min(nearest, depths.depths[depths.at(x, y, s)]);
      const auto at = static_cast<std::size_t>(tile.rect.y - of.y + y) * static_cast<std::size_t>(of.width) +
                      static_cast<std::size_t>(tile.rect.x - of.x + x);
      out[at] = nearest;
    }
  }
}

Image depthsIn(const ShadowPlan& plan, const CastTiles& cast, const Rect& rect, const ShadowTile* only,
               const ViewRequest& request) {
  std::vector<float> depths(static_cast<std::size_t>(rect.width) * static_cast<std::size_t>(rect.height), 1.0f);
  for (std::size_t i = 0; i < plan.tiles.size(); ++i) {
    const ShadowTile& tile = plan.tiles[i];
    if (cast.tiles[i] && (only == nullptr || only == &tile)) addDepths(tile, cast.tiles[i]->depths, rect, depths);
  }
  return depthImage(rect.width, rect.height, depths, request.encoded, request.fine);
}

} // namespace

CastTiles castTiles(const CastInput& input, TileStore& store) {
  const std::vector<ShadowTile>& tiles = input.plan.tiles;
  const std::vector<const Light*> lightOf = lightsOfTiles(input.plan, *input.spec.lights);
  CastTiles cast;
  cast.tiles.resize(tiles.size());
  cast.casters.resize(tiles.size());
  cast.facts.resize(tiles.size());
  const int samples = input.spec.atlas.samples;
  std::vector<TileKey> keys(tiles.size());
  for (std::size_t i = 0; i < tiles.size(); ++i) { // all are found before the first makes room for another
    const ShadowTile& tile = tiles[i];
    if (tile.rect.width <= 0) continue;
    const auto start = std::chrono::steady_clock::now();
    cast.casters[i] = castersInto(tile, *lightOf[i], input.scene.view, input.scene.geometry, input.nodes);
    keys[i] = tileKey(input.sceneId, input.view, tile, *lightOf[i], cast.casters[i], samples);
    cast.tiles[i] = store.find(keys[i]);
    cast.facts[i].reused = cast.tiles[i] != nullptr;
    if (!cast.facts[i].reused) addTime(cast.facts[i], millisecondsSince(start));
  }
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    const ShadowTile& tile = tiles[i];
    TileFacts& facts = cast.facts[i];
    if (tile.rect.width <= 0 || facts.reused) continue;
    const auto start = std::chrono::steady_clock::now();
    cast.tiles[i] = std::make_shared<RasteredTile>(emptyTile(tile, samples, store));
    store.keep(keys[i], cast.tiles[i]);
    addCasters(input, rasterDraws(input.scene, cast.casters[i].use, cast.casters[i].slots), facts);
    addTime(facts, millisecondsSince(start));
  }
  return cast;
}

std::vector<TexelMarks> noTexels(const ShadowPlan& plan) {
  std::vector<TexelMarks> marks;
  for (const ShadowTile& tile : plan.tiles) marks.emplace_back(tile.rect.width, tile.rect.height);
  return marks;
}

void makeTexels(const CastInput& input, std::span<const TexelMarks> read, CastTiles& cast) {
  const std::vector<const Light*> lightOf = lightsOfTiles(input.plan, *input.spec.lights);
  for (std::size_t i = 0; i < cast.tiles.size(); ++i) {
    if (cast.tiles[i] == nullptr || !read[i].any()) continue;
    const ShadowTile& tile = input.plan.tiles[i];
    RasteredTile& made = *cast.tiles[i];
    const MomentBlur blur = momentBlur(tile);
    const TexelMarks unblurred = isBlurred(tile) ? read[i].without(made.blurred) : TexelMarks();
    const glm::ivec2 around = readAround(blur);
    const TexelMarks wanted = (isBlurred(tile) ? unblurred.grown(around.x, around.y) : read[i]).without(made.made);
    if (!wanted.any() && !unblurred.any()) continue;
    const auto start = std::chrono::steady_clock::now();
    if (wanted.any()) {
      std::vector<RasterDraw> draws = rasterDraws(input.scene, cast.casters[i].use, cast.casters[i].slots);
      draws = drawsInto(input, tile, wanted, std::move(draws));
      rasterCasters(input, tile, *lightOf[i], draws, &wanted, made.depths);
      made.made.add(wanted);
    }
    if (unblurred.any()) {
      blurMoments(made.depths, blur, unblurred, made.moments);
      made.blurred.add(unblurred);
    }
    addTime(cast.facts[i], millisecondsSince(start));
  }
}

DepthBuffer numberedTile(const CastInput& input, const ShadowTile& tile, const Light& light) {
  DepthBuffer buffer = unfilledBuffer(tile.rect.width, tile.rect.height, 1, true);
  const TileCasters casters = castersInto(tile, light, input.scene.view, input.scene.geometry, input.nodes);
  rasterCasters(input, tile, light, rasterDraws(input.scene, casters.use, casters.slots), nullptr, buffer);
  return buffer;
}

ShownLights::ShownLights(const ShadowPlan& plan, std::span<const LitLight> lights, const CastTiles& cast)
    : lights_(lightData(lights)),
      tiles_(tileData(plan)),
      maps_(tileMaps(plan, cast)),
      atlas_(plan.atlasWidth, plan.atlasHeight) {}

Image atlasPicture(const ShowInput& input, const ViewRequest& request, const CastTiles& cast) {
  if (request.view == View::tile) return depthsIn(input.plan, cast, input.tile->rect, input.tile, request);
  const Rect whole{0, 0, input.plan.atlasWidth, input.plan.atlasHeight};
  Image image = depthsIn(input.plan, cast, whole, nullptr, request);
  return request.encoded ? namedTiles(image, input.plan) : image;
}

} // namespace gnomon::cpu
