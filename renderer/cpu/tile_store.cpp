#include "renderer/cpu/tile_store.h"

#include <algorithm>
#include <functional>
#include <iterator>
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
  const auto entry = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& each) { return each.key == key; });
  if (entry == entries_.end()) return nullptr;
  entries_.splice(entries_.begin(), entries_, entry);
  entry->found = true;
  return entry->tile;
}

TileStore::Entries::iterator TileStore::nextToDrop(std::size_t bytes) {
  const auto oldest = [this](auto where) {
    const auto entry = std::find_if(entries_.rbegin(), entries_.rend(), where);
    return entry == entries_.rend() ? entries_.end() : std::prev(entry.base());
  };
  if (newBytes() + bytes > budgetBytes_ / 4) {
    const auto passed = oldest([](const Entry& each) { return !each.found && each.tile.use_count() == 1; });
    if (passed != entries_.end()) return passed;
  }
  return this->bytes() + bytes > budgetBytes_ ? oldest([](const Entry&) { return true; }) : entries_.end();
}

std::size_t TileStore::bytes() const {
  return std::transform_reduce(entries_.begin(), entries_.end(), std::size_t{0}, std::plus<>(),
                               [](const Entry& entry) { return entry.tile->bytes(); });
}

std::size_t TileStore::newBytes() const {
  return std::transform_reduce(entries_.begin(), entries_.end(), std::size_t{0}, std::plus<>(),
                               [](const Entry& entry) { return entry.found ? 0 : entry.tile->bytes(); });
}

RasteredTile TileStore::room(std::size_t bytes) {
  RasteredTile storage;
  for (auto entry = nextToDrop(bytes); entry != entries_.end(); entry = nextToDrop(bytes)) {
    if (entry->tile.use_count() == 1 && depthBytes(*entry->tile) == bytes) storage = std::move(*entry->tile);
    entries_.erase(entry);
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
