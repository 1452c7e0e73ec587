#include "renderer/cpu/tile_store.h"

#include <algorithm>

namespace gnomon::cpu {

std::size_t RasteredTile::bytes() const {
  const auto texels = static_cast<std::size_t>(depths.width) * static_cast<std::size_t>(depths.height);
  return depths.places() * sizeof(float) + (blurred ? texels * sizeof(glm::vec4) : 0);
}

std::shared_ptr<RasteredTile> TileStore::find(const TileKey& key) {
  const auto found =
      std::find_if(entries_.begin(), entries_.end(), [&](const Entry& entry) { return entry.key == key; });
  if (found == entries_.end()) return nullptr;
  entries_.splice(entries_.begin(), entries_, found);
  return found->tile;
}

DepthBuffer TileStore::room(std::size_t bytes) {
  DepthBuffer storage;
  while (!entries_.empty() && bytes_ + bytes > budgetBytes_) {
    Entry& last = entries_.back();
    if (last.tile.use_count() == 1 && last.bytes == bytes) storage = std::move(last.tile->depths);
    bytes_ -= last.bytes;
    entries_.pop_back();
  }
  return storage;
}

void TileStore::keep(const TileKey& key, std::shared_ptr<RasteredTile> tile) {
  const std::size_t bytes = tile->bytes();
  room(bytes);
  if (bytes_ + bytes > budgetBytes_) return;
  bytes_ += bytes;
  entries_.push_front({key, std::move(tile), bytes});
}

} // namespace gnomon::cpu
