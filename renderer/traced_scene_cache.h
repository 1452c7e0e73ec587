#pragma once

#include <list>
#include <memory>

#include "renderer/reference/traced_scene.h"

namespace gnomon {

/// Scenes sorted for rays, the least recently used dropped first once they take more than a budget.
class TracedSceneCache {
 public:
  explicit TracedSceneCache(std::size_t budgetBytes) : budgetBytes_(budgetBytes) {}

  /// One of the scene's glTF scenes, sorted now if need be. The newest stays, whatever its size.
  Result<std::shared_ptr<const TracedScene>> get(const std::shared_ptr<const Scene>& scene, int index);

 private:
  struct Entry {
    std::weak_ptr<const Scene> scene;
    int index = 0;
    std::shared_ptr<const TracedScene> traced;
  };

  std::size_t budgetBytes_;
  std::list<Entry> entries_; ///< most recently used first
};

} // namespace gnomon
