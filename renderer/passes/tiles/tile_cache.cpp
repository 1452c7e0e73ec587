#include "renderer/passes/tiles/tile_cache.h"

#include <algorithm>

namespace gnomon {

std::size_t AtlasTextures::bytes() const {
  return depth.bytes() + moments.bytes();
}

std::shared_ptr<const AtlasTextures> TileCache::findAll(std::span<const TileKey> keys) {
  const auto found = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& entry) {
    return std::all_of(keys.begin(), keys.end(), [&](const TileKey& key) {
      return std::binary_search(entry.keys.begin(), entry.keys.end(), key);
    });
  });
  if (found == entries_.end()) return nullptr;
  entries_.splice(entries_.begin(), entries_, found);
  return found->textures;
}

std::shared_ptr<const AtlasTextures> TileCache::find(const TileKey& key) {
  return findAll(std::span(&key, 1));
}

void TileCache::keep(std::vector<TileKey> keys, std::shared_ptr<const AtlasTextures> textures) {
  if (textures->bytes() > budgetBytes_) return;
  std::sort(keys.begin(), keys.end());
  // What the new atlas holds as well is nothing worth.
  entries_.remove_if([&](const Entry& entry) {
    return std::includes(keys.begin(), keys.end(), entry.keys.begin(), entry.keys.end());
  });
  entries_.push_front({std::move(keys), std::move(textures)});
  std::size_t bytes = 0;
  for (auto entry = entries_.begin(); entry != entries_.end();) {
    bytes += entry->textures->bytes();
    entry = bytes <= budgetBytes_ ? std::next(entry) : entries_.erase(entry);
  }
}

} // namespace gnomon
