#include "server/bakes/bake_book.h"

#include <algorithm>

namespace gnomon {

/// With the mutex held.
std::list<BakeBook::Entry>::iterator BakeBook::at(const BakeName& name) {
  return std::find_if(entries_.begin(), entries_.end(), [&](const Entry& entry) { return entry.name == name; });
}

std::shared_ptr<const std::atomic<bool>> BakeBook::begin(const BakeName& name, const FrameSpec& spec) {
  const std::lock_guard lock(mutex_);
  if (const auto known = at(name); known != entries_.end()) {
    entries_.splice(entries_.begin(), entries_, known);
    return known->removed;
  }
  entries_.push_front({name, spec, false, std::make_shared<std::atomic<bool>>(false)});
  if (entries_.size() > kMost) {
    entries_.pop_back();
  }
  return entries_.front().removed;
}

void BakeBook::end(const BakeName& name, bool made) {
  const std::lock_guard lock(mutex_);
  const auto entry = at(name);
  if (entry == entries_.end()) {
    return;
  }
  if (made) {
    entry->done = true;
  } else if (!entry->done) {
    entries_.erase(entry);
  }
}

std::optional<FrameSpec> BakeBook::find(const BakeName& name) {
  const std::lock_guard lock(mutex_);
  const auto entry = at(name);
  if (entry == entries_.end() || !entry->done) {
    return std::nullopt;
  }
  entries_.splice(entries_.begin(), entries_, entry);
  return entry->spec;
}

bool BakeBook::remove(const BakeName& name) {
  const std::lock_guard lock(mutex_);
  const auto entry = at(name);
  if (entry == entries_.end()) {
    return false;
  }
  *entry->removed = true;
  entries_.erase(entry);
  return true;
}

} // namespace gnomon
