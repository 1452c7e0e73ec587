#include "server/worker/scene_cache.h"

namespace gnomon {

std::optional<LoadedScene> SceneCache::get(const std::string& id) {
  const std::lock_guard lock(mutex_);
  const auto found = byId_.find(id);
  if (found == byId_.end()) return std::nullopt;
  scenes_.splice(scenes_.begin(), scenes_, found->second);
  return scenes_.front();
}

void SceneCache::put(LoadedScene loaded) {
  const std::lock_guard lock(mutex_);
  if (const auto found = byId_.find(loaded.summary.id); found != byId_.end()) {
    scenes_.splice(scenes_.begin(), scenes_, found->second);
    return;
  }
  bytes_ += loaded.summary.memoryBytes;
  scenes_.push_front(std::move(loaded));
  byId_[scenes_.front().summary.id] = scenes_.begin();
  while (bytes_ > budget_ && scenes_.size() > 1) {
    bytes_ -= scenes_.back().summary.memoryBytes;
    byId_.erase(scenes_.back().summary.id);
    scenes_.pop_back();
  }
}

bool SceneCache::remove(const std::string& id) {
  const std::lock_guard lock(mutex_);
  const auto found = byId_.find(id);
  if (found == byId_.end()) return false;
  bytes_ -= found->second->summary.memoryBytes;
  scenes_.erase(found->second);
  byId_.erase(found);
  return true;
}

std::size_t SceneCache::bytes() const {
  const std::lock_guard lock(mutex_);
  return bytes_;
}

std::size_t SceneCache::count() const {
  const std::lock_guard lock(mutex_);
  return scenes_.size();
}

} // namespace gnomon
