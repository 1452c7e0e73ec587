#include "renderer/volume/volume_light_store.h"

#include <algorithm>

namespace gnomon {
namespace {

std::size_t bytesOf(const VolumeLight& map) {
  return map.texels.size() * sizeof(map.texels.front());
}

} // namespace

VolumeLightKey::VolumeLightKey(const VolumeLightInput& input, std::string lights, std::string casters)
    : chosen_(input.chosen),
      towards_(input.towards),
      size_(input.size),
      lights_(std::move(lights)),
      casters_(std::move(casters)) {
  for (const Medium* medium : input.media) {
    media_.push_back({medium->grid, medium->function, medium->space, medium->castShadow, medium->receiveShadow});
  }
}

bool VolumeLightKey::same(const Part& a, const Part& b) {
  const bool sameGrid = !a.grid.owner_before(b.grid) && !b.grid.owner_before(a.grid);
  return sameGrid && a.function == b.function && a.space == b.space && a.castShadow == b.castShadow &&
         a.receiveShadow == b.receiveShadow;
}

bool VolumeLightKey::operator==(const VolumeLightKey& other) const {
  return chosen_ == other.chosen_ && towards_ == other.towards_ && size_ == other.size_ && lights_ == other.lights_ &&
         casters_ == other.casters_ &&
         std::equal(media_.begin(), media_.end(), other.media_.begin(), other.media_.end(), same);
}

bool VolumeLightStore::holds(const VolumeLightKey& key) const {
  return std::any_of(entries_.begin(), entries_.end(), [&](const Entry& entry) { return entry.first == key; });
}

VolumeLightStore::Found VolumeLightStore::mapOf(const VolumeLightKey& key, const std::function<VolumeLight()>& make) {
  if (const Entry* const found = entries_.find(key, &Entry::first)) return {found->second, false};
  const auto made = std::make_shared<const VolumeLight>(make());
  entries_.add({key, made});
  entries_.keepWithin(maxBytes_, [](const Entry& entry) { return bytesOf(*entry.second); });
  if (bytesOf(*made) > maxBytes_) entries_.keepNewest(0);
  return {made, true};
}

} // namespace gnomon
