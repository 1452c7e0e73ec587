#include "server/scenes/scene_memory.h"

#include <algorithm>

namespace gnomon {
namespace {

constexpr std::uint64_t kEachBytes = 8'192; ///< of each besides its own: its last page, its file, its entry

} // namespace

/// With the mutex held.
std::list<SceneMemory::Entry>::const_iterator SceneMemory::find(const std::string& id) const {
  return std::find_if(entries_.begin(), entries_.end(), [&](const Entry& entry) { return entry.id == id; });
}

bool SceneMemory::put(const std::string& id, BundlePtr bundle, std::uint64_t bytes, const std::string& summary) {
  const std::lock_guard lock(mutex_);
  if (const auto known = find(id); known != entries_.end()) {
    entries_.splice(entries_.begin(), entries_, known);
    return false;
  }
  entries_.push_front({id, std::move(bundle), bytes + summary.size() + kEachBytes, summary});
  bytes_ += entries_.front().bytes;
  while (entries_.size() > 1 && (bytes_ > budget_ || entries_.size() > most_)) {
    bytes_ -= entries_.back().bytes;
    entries_.pop_back();
  }
  return true;
}

void SceneMemory::replaceSummary(const std::string& id, const std::string& summary) {
  const std::lock_guard lock(mutex_);
  const auto known = find(id);
  if (known == entries_.end()) return;
  entries_.splice(entries_.begin(), entries_, known);
  Entry& entry = entries_.front();
  bytes_ += summary.size() - entry.summary.size();
  entry.bytes += summary.size() - entry.summary.size();
  entry.summary = summary;
}

BundlePtr SceneMemory::bundle(const std::string& id) {
  const std::lock_guard lock(mutex_);
  const auto known = find(id);
  if (known == entries_.end()) return nullptr;
  entries_.splice(entries_.begin(), entries_, known);
  return entries_.front().bundle;
}

std::optional<std::string> SceneMemory::summary(const std::string& id) const {
  const std::lock_guard lock(mutex_);
  const auto known = find(id);
  return known == entries_.end() ? std::nullopt : std::optional(known->summary);
}

bool SceneMemory::contains(const std::string& id) const {
  const std::lock_guard lock(mutex_);
  return find(id) != entries_.end();
}

ScenePage SceneMemory::page(std::string_view after, std::size_t limit) const {
  PageFinder finder(after, limit);
  const std::lock_guard lock(mutex_);
  for (const Entry& entry : entries_) finder.see(entry.id);
  return std::move(finder).page();
}

StoreSize SceneMemory::size() const {
  const std::lock_guard lock(mutex_);
  return {entries_.size(), bytes_};
}

bool SceneMemory::remove(const std::string& id) {
  const std::lock_guard lock(mutex_);
  const auto known = find(id);
  if (known == entries_.end()) return false;
  bytes_ -= known->bytes;
  entries_.erase(known);
  return true;
}

} // namespace gnomon
