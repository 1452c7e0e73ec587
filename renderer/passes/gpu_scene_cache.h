#pragma once

#include <memory>

#include "protocol/base/lru.h"
#include "renderer/passes/gpu_scene.h"
#include "renderer/passes/stencil/stencil_outlines.h"

namespace gnomon {

/// Uploaded scenes, those with the same surfaces as one, the least recently used dropped first once they take more than
/// a budget.
class GpuSceneCache {
 public:
  explicit GpuSceneCache(std::size_t budgetBytes) : budgetBytes_(budgetBytes) {}

  /// The scene's upload, made now if need be; valid until the next call. The newest stays, whatever its size.
  const GpuScene& get(const std::shared_ptr<const Scene>& scene);
  /// The edges of its meshes, found now if need be; alike.
  const std::vector<EdgeMesh>& edges(const std::shared_ptr<const Scene>& scene);

 private:
  struct Entry {
    std::weak_ptr<const Scene> scene;
    GpuScene gpu;
    std::shared_ptr<const std::vector<EdgeMesh>> edges{};

    std::size_t bytes() const { return gpu.bytes + (edges ? bytesOf(*edges) : 0); }
  };

  Entry& entryOf(const std::shared_ptr<const Scene>& scene);
  void drop();

  std::size_t budgetBytes_;
  std::uint64_t uploads_ = 0;
  LruList<Entry> entries_;
};

} // namespace gnomon
