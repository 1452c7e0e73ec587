#include "renderer/scene/animation/pose_cache.h"

#include <algorithm>

namespace gnomon {

Result<std::shared_ptr<const Scene>> PoseCache::get(std::size_t animation, double timeSeconds, const Make& make) {
  const std::lock_guard lock(mutex_);
  const auto found = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& entry) {
    return entry.animation == animation && entry.timeSeconds == timeSeconds;
  });
  if (found != entries_.end()) {
    entries_.splice(entries_.begin(), entries_, found);
    return entries_.front().scene;
  }
  auto made = make();
  if (!made) return made;
  entries_.push_front({animation, timeSeconds, *made});
  if (entries_.size() > kKept) entries_.pop_back();
  return made;
}

} // namespace gnomon
