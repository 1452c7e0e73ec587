#include "renderer/cpu/tile_store.h"

#include <algorithm>
#include <functional>
#include <numeric>

namespace gnomon::cpu {

namespace {

std::size_t depthBytes(const RasteredTile& tile) {
  return tile.depths.places() * sizeof(float);
}

} // namespace

std::size_t RasteredTile::bytes() const {
  return depthBytes(*this) + blurred.count() * kMarkSide * kMarkSide * sizeof(glm::vec4);
}

std::shared_ptr<RasteredTile> TileStore::find(const TileKey& key) {
  const auto found =
      std::find_if(entries_.begin(), entries_.end(), [&](const Entry& entry) { return entry.key == key; });
  if (found == entries_.end()) return nullptr;
  entries_.splice(entries_.begin(), entries_, found);
  return found->tile;
}

std::size_t TileStore::bytes() const {
  return std::transform_reduce(entries_.begin(), entries_.end(), std::size_t{0}, std::plus<>(),
                               [](const Entry& entry) { return entry.tile->bytes(); });
}

RasteredTile TileStore::room(std::size_t bytes) {
  RasteredTile storage;
  while (!entries_.empty() && this->bytes() + bytes > budgetBytes_) {
    Entry& last = entries_.back();
    if (last.tile.use_count() == 1 && depthBytes(*last.tile) == bytes) storage = std::move(*last.tile);
    entries_.pop_back();
  }
  return storage;
}

void TileStore::keep(const TileKey& key, std::shared_ptr<RasteredTile> tile) {
  const std::size_t bytes = tile->bytes();
  room(bytes);
  if (this->bytes() + bytes > budgetBytes_) return;
  entries_.push_front({key, std::move(tile)});
}

} // namespace gnomon::cpu
