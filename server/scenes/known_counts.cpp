#include "server/scenes/known_counts.h"

namespace gnomon {

std::optional<SceneCounts> KnownCounts::find(const std::string& id) {
  const std::lock_guard lock(mutex_);
  const Entry* const known = entries_.find(id, &Entry::first);
  return known ? std::optional(known->second) : std::nullopt;
}

void KnownCounts::keep(const std::string& id, SceneCounts counts) {
  if (counts.lights.size() > kMostLights) counts.lights.resize(kMostLights);
  const std::lock_guard lock(mutex_);
  entries_.add({id, std::move(counts)});
  entries_.keepNewest(kMost);
}

bool KnownCounts::forget(const std::string& id) {
  const std::lock_guard lock(mutex_);
  return entries_.eraseIf([&](const Entry& entry) { return entry.first == id; }) > 0;
}

} // namespace gnomon
