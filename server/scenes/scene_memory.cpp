#include "server/scenes/scene_memory.h"

#include <algorithm>
#include <numeric>

namespace gnomon {
namespace {

constexpr std::uint64_t kEachBytes = 8'192; ///< of each besides its own: its last page, its file, its entry

} // namespace

std::uint64_t SceneMemory::Entry::bytes() const {
  return bundleBytes + summary.size() + kEachBytes;
}

/// With the mutex held; does not mark it as used.
const SceneMemory::Entry* SceneMemory::look(const std::string& id) const {
  const auto known = std::ranges::find(entries_, id, &Entry::id);
  return known == entries_.end() ? nullptr : &*known;
}

bool SceneMemory::put(const std::string& id, BundlePtr bundle, std::uint64_t bytes, const std::string& summary) {
  const std::lock_guard lock(mutex_);
  if (entries_.find(id, &Entry::id)) return false;
  entries_.add({id, std::move(bundle), bytes, summary});
  entries_.keepNewest(most_);
  entries_.keepWithin(budget_, [](const Entry& entry) { return entry.bytes(); });
  return true;
}

void SceneMemory::replaceSummary(const std::string& id, const std::string& summary) {
  const std::lock_guard lock(mutex_);
  if (Entry* const known = entries_.find(id, &Entry::id)) known->summary = summary;
}

BundlePtr SceneMemory::bundle(const std::string& id) {
  const std::lock_guard lock(mutex_);
  const Entry* const known = entries_.find(id, &Entry::id);
  return known ? known->bundle : nullptr;
}

std::optional<std::string> SceneMemory::summary(const std::string& id) const {
  const std::lock_guard lock(mutex_);
  const Entry* const known = look(id);
  return known ? std::optional(known->summary) : std::nullopt;
}

bool SceneMemory::contains(const std::string& id) const {
  const std::lock_guard lock(mutex_);
  return look(id) != nullptr;
}

ScenePage SceneMemory::page(std::string_view after, std::size_t limit) const {
  PageFinder finder(after, limit);
  const std::lock_guard lock(mutex_);
  for (const Entry& entry : entries_) finder.see(entry.id);
  return std::move(finder).page();
}

StoreSize SceneMemory::size() const {
  const std::lock_guard lock(mutex_);
  const std::uint64_t bytes = std::transform_reduce(entries_.begin(), entries_.end(), std::uint64_t{0}, std::plus<>(),
                                                    [](const Entry& entry) { return entry.bytes(); });
  return {entries_.size(), bytes};
}

bool SceneMemory::remove(const std::string& id) {
  const std::lock_guard lock(mutex_);
  return entries_.eraseIf([&](const Entry& entry) { return entry.id == id; }) > 0;
}

} // namespace gnomon
