#include "server/bakes/bake_registry.h"

#include <algorithm>

namespace gnomon {

std::shared_ptr<const std::atomic<bool>> BakeRegistry::begin(const BakeName& name, const FrameSpec& spec) {
  const std::lock_guard lock(mutex_);
  if (const Entry* const known = entries_.find(name, &Entry::name)) return known->removed;
  const Entry& added = entries_.add({name, spec, false, std::make_shared<std::atomic<bool>>(false)});
  entries_.keepNewest(kMost);
  return added.removed;
}

void BakeRegistry::end(const BakeName& name, bool made) {
  const std::lock_guard lock(mutex_);
  if (!made) {
    entries_.eraseIf([&](const Entry& entry) { return entry.name == name && !entry.done; });
  } else if (const auto entry = std::ranges::find(entries_, name, &Entry::name); entry != entries_.end()) {
    entry->done = true;
  }
}

std::optional<FrameSpec> BakeRegistry::find(const BakeName& name) {
  const std::lock_guard lock(mutex_);
  const Entry* const entry = entries_.findIf([&](const Entry& each) { return each.name == name && each.done; });
  return entry ? std::optional(entry->spec) : std::nullopt;
}

bool BakeRegistry::remove(const BakeName& name) {
  const std::lock_guard lock(mutex_);
  const Entry* const entry = entries_.find(name, &Entry::name);
  if (!entry) return false;
  *entry->removed = true;
  entries_.eraseIf([&](const Entry& each) { return &each == entry; });
  return true;
}

} // namespace gnomon
