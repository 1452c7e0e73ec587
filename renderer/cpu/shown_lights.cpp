#include "renderer/cpu/shown_lights.h"

#include "renderer/device/shader_data.h"

namespace gnomon::cpu {
namespace {

std::vector<TileMap> tileMaps(const ShadowPlan& plan, const CastTiles& cast) {
  std::vector<TileMap> maps;
  for (std::size_t i = 0; i < plan.tiles.size(); ++i) {
    const RasteredTile* tile = cast.tiles[i].get();
    maps.push_back({plan.tiles[i].rect, tile ? &tile->depths : nullptr,
                    tile ? std::span<const glm::vec4>(tile->moments) : std::span<const glm::vec4>{}});
  }
  return maps;
}

} // namespace

ShownLights::ShownLights(const ShadowPlan& plan, std::span<const LitLight> lights, const CastTiles& cast)
    : lights_(lightData(lights)),
      tiles_(tileData(plan)),
      maps_(tileMaps(plan, cast)),
      atlas_(plan.atlasWidth, plan.atlasHeight) {}

} // namespace gnomon::cpu
