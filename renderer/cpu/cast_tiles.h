#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "renderer/cpu/raster/raster.h"
#include "renderer/cpu/shadow/shadow_maps.h"
#include "renderer/cpu/surface/textures.h"
#include "renderer/cpu/tile_store.h"
#include "renderer/device/device.h"
#include "renderer/prepare/cluster_choice.h"
#include "renderer/shadow/shadow_plan.h"

namespace gnomon::cpu {

/// What the tiles of a frame are cast from. All of it outlives the call.
struct CastInput {
  const FrameScene& scene;
  const Textures& textures;
  const ShadowPlan& plan;
  const FrameSpec& spec; ///< effective
  std::span<const NodeSwitches> nodes;
  std::uint64_t sceneId = 0; ///< a number that no other scene has
  int view = 0;              ///< index into Scene::scenes
  RasterScratch& scratch;
};

struct CastTiles {
  std::vector<std::shared_ptr<RasteredTile>> tiles; ///< one a tile of the plan; null where it has no texels
  std::vector<TileCasters> casters;                 ///< parallel
  std::vector<TileFacts> facts;                     ///< parallel
};

/// Tiles that the store has are taken from it, and it keeps the new ones; these have no texels yet.
CastTiles castTiles(const CastInput& input, TileStore& store);

/// Nothing of each tile.
std::vector<TexelMarks> noTexels(const ShadowPlan& plan);

/// Rasters what is to be read and was not made yet. `read`: one a tile. A texel is the same whichever others are made
/// with it, before it or after it.
void makeTexels(const CastInput& input, std::span<const TexelMarks> read, CastTiles& cast);

/// The tile's casters once more, with the number of the triangle nearest to the light in each texel; one sample a
/// texel.
DepthBuffer numberedTile(const CastInput& input, const ShadowTile& tile, const Light& light);

/// The lights and tiles of a frame as kernels read them. Refers to the tiles.
class ShownLights {
 public:
  ShownLights(const ShadowPlan& plan, std::span<const LitLight> lights, const CastTiles& cast);

  ShadowMaps maps(std::span<const Layer> layers) const { return {lights_, tiles_, maps_, atlas_, layers}; }

 private:
  std::vector<shared::LightData> lights_;
  std::vector<shared::TileData> tiles_;
  std::vector<TileMap> maps_;
  glm::vec2 atlas_;
};

/// View `atlas` or `tile`, as `request` asks: the depths of all tiles, or of the input's. REQUIRES: all of their texels
/// are made.
Image atlasPicture(const ShowInput& input, const ViewRequest& request, const CastTiles& cast);

} // namespace gnomon::cpu
