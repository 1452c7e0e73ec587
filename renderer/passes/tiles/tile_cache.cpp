#include "renderer/passes/tiles/tile_cache.h"

#include <algorithm>

namespace gnomon {

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
