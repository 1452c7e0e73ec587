#include "server/scenes/known_counts.h"

#include <algorithm>

namespace gnomon {

std::optional<SceneCounts> KnownCounts::find(const std::string& id) {
  const std::lock_guard lock(mutex_);
  const auto known =
      std::find_if(entries_.begin(), entries_.end(), [&](const auto& entry) { return entry.first == id; });
  if (known == entries_.end()) return std::nullopt;
  entries_.splice(entries_.begin(), entries_, known);
  return entries_.front().second;
}

void KnownCounts::keep(const std::string& id, SceneCounts counts) {
  if (counts.lights.size() > kMostLights) counts.lights.resize(kMostLights);
  const std::lock_guard lock(mutex_);
  entries_.emplace_front(id, std::move(counts));
  if (entries_.size() > kMost) entries_.pop_back();
}

bool KnownCounts::forget(const std::string& id) {
  const std::lock_guard lock(mutex_);
  return entries_.remove_if([&](const auto& entry) { return entry.first == id; }) > 0;
}

} // namespace gnomon
