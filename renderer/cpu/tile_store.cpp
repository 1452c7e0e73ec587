#include "renderer/cpu/tile_store.h"

#include <algorithm>
#include <iterator>

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
  const auto known = places_.find(key);
  if (known == places_.end()) return nullptr;
  const Place place = known->second;
  Entries& before = entriesOf(*place);
  before.bytes -= place->bytes;
  found_.bytes += place->bytes;
  found_.list.splice(found_.list.begin(), before.list, place);
  place->found = true;
  place->used = ++uses_;
  watch(place);
  return place->tile;
}

/// Its moments grow while a frame uses it.
void TileStore::watch(Place place) {
  if (!place->tile->moments.empty()) watched_.push_back(place);
}

void TileStore::countWatched() {
  for (const Place place : watched_) {
    const std::size_t bytes = place->tile->bytes();
    Entries& entries = entriesOf(*place);
    entries.bytes = entries.bytes - place->bytes + bytes;
    place->bytes = bytes;
  }
  std::erase_if(watched_, [](Place place) { return place->tile.use_count() == 1; });
}

std::optional<TileStore::Place> TileStore::nextToDrop(std::size_t bytes) {
  if (unfound_.bytes + bytes > budgetBytes_ / 4) {
    const auto passed = std::find_if(unfound_.list.rbegin(), unfound_.list.rend(),
                                     [](const Entry& entry) { return entry.tile.use_count() == 1; });
    if (passed != unfound_.list.rend()) return std::prev(passed.base());
  }
  if (found_.bytes + unfound_.bytes + bytes <= budgetBytes_ || places_.empty()) return std::nullopt;
  const bool fromFound =
      unfound_.list.empty() || (!found_.list.empty() && found_.list.back().used < unfound_.list.back().used);
  return std::prev((fromFound ? found_ : unfound_).list.end());
}

void TileStore::drop(Place place) {
  Entries& entries = entriesOf(*place);
  entries.bytes -= place->bytes;
  places_.erase(place->key);
  std::erase(watched_, place);
  entries.list.erase(place);
}

RasteredTile TileStore::room(std::size_t bytes) {
  countWatched();
  RasteredTile storage;
  while (const auto place = nextToDrop(bytes)) {
    const auto& tile = (*place)->tile;
    if (tile.use_count() == 1 && depthBytes(*tile) == bytes) storage = std::move(*tile);
    drop(*place);
  }
  return storage;
}

void TileStore::keep(const TileKey& key, std::shared_ptr<RasteredTile> tile) {
  const std::size_t bytes = tile->bytes();
  room(bytes);
  if (bytes > budgetBytes_ || places_.contains(key)) return;
  unfound_.list.push_front({key, std::move(tile), bytes, ++uses_});
  unfound_.bytes += bytes;
  const Place place = unfound_.list.begin();
  places_.emplace(place->key, place);
  watch(place);
}

} // namespace gnomon::cpu
