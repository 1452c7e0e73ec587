#include "renderer/cpu/atlas_picture.h"

#include <algorithm>

#include "renderer/device/view_image.h"
#include "renderer/prepare/named_tiles.h"

namespace gnomon::cpu {
namespace {

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

Image atlasPicture(const ShowInput& input, const ViewRequest& request, const CastTiles& cast) {
  if (request.view == View::tile) return depthsIn(input.plan, cast, input.tile->rect, input.tile, request);
  const Rect whole{0, 0, input.plan.atlasWidth, input.plan.atlasHeight};
  Image image = depthsIn(input.plan, cast, whole, nullptr, request);
  return request.encoded ? namedTiles(image, input.plan) : image;
}

} // namespace gnomon::cpu
