#pragma once

#include <list>
#include <memory>

#include "renderer/passes/gpu_scene.h"

namespace gnomon {

/// Uploaded scenes, the least recently used dropped first once they take more than a budget.
class GpuSceneCache {
 public:
  explicit GpuSceneCache(std::size_t budgetBytes) : budgetBytes_(budgetBytes) {}

  /// The scene's upload, made now if need be; valid until the next call. The newest stays, whatever its size.
  const GpuScene& get(const std::shared_ptr<const Scene>& scene);

 private:
  struct Entry {
    std::weak_ptr<const Scene> scene;
    GpuScene gpu;
  };

  void drop();

  std::size_t budgetBytes_;
  std::uint64_t uploads_ = 0;
  std::list<Entry> entries_; ///< most recently used first
};

} // namespace gnomon
