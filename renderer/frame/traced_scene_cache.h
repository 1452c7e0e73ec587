#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "protocol/base/lru.h"
#include "protocol/base/result.h"
#include "renderer/rays/traced_scene.h"

namespace gnomon {

/// Scenes sorted for rays, the least recently used dropped first once they take more than a budget or are more than
/// 256, and those that are in use nowhere else. Any thread; one that asks for a scene waits while another is made.
class TracedSceneCache {
 public:
  explicit TracedSceneCache(std::size_t budgetBytes) : budgetBytes_(budgetBytes) {}

  /// Made now if need be, or that of a scene with the same surfaces. `index` into Scene::scenes. The newest stays,
  /// whatever its size.
  Result<std::shared_ptr<const TracedScene>> get(const std::shared_ptr<const Scene>& scene, int index);

 private:
  struct Entry {
    std::weak_ptr<const Scene> scene; ///< the last that asked
    int index = 0;
    std::shared_ptr<const TracedScene> traced;
  };

  static std::uint64_t olderSceneBytes(const Entry& entry);
  std::vector<const TracedScene*> outOfUse() const;
  void drop();

  std::size_t budgetBytes_;
  std::timed_mutex mutex_;
  LruList<Entry> entries_;
};

} // namespace gnomon
