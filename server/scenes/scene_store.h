#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/base/result.h"
#include "server/scenes/known_counts.h"
#include "server/scenes/light_map_directory.h"
#include "server/scenes/scene_directory.h"
#include "server/scenes/scene_memory.h"

namespace gnomon {

struct SceneStoreOptions {
  std::string directory;                ///< empty = scenes are in memory only, and the least recently used are dropped
  std::size_t memoryBytes = 1ull << 30; ///< of their bundles, where there is no directory
  std::shared_ptr<LightMapDirectory> lightMaps{}; ///< those of a scene go with it; nullptr = there are none
};

/// The notFound problem of a route that names a scene.
Problem unknownScene(std::string_view id);

/// A bundle as it is sent to a worker.
struct StoredBundle {
  BundlePtr file;
  bool isStored = false; ///< it comes from a disk, and may be damaged
};

/// Scenes by id: their bundles, and the summaries that workers made of them. Nothing here reads a scene. Any thread.
class SceneStore {
 public:
  static Result<std::unique_ptr<SceneStore>> open(const SceneStoreOptions& options);

  /// Keeps a scene that a worker could load. False where it is there already. `bytes`: of the bundle.
  Result<bool> put(const std::string& id, BundlePtr bundle, std::uint64_t bytes, const std::string& summary);

  /// notFound, or unavailable where the disk refuses.
  Result<StoredBundle> bundle(const std::string& id);

  bool contains(const std::string& id);
  std::vector<std::string> ids(); ///< ascending
  StoreUse use() const;

  /// What the scene holds, as JSON; nothing where it is missing, damaged, or of another version.
  std::optional<std::string> summary(const std::string& id) const;
  void keepSummary(const std::string& id, const std::string& summary);

  /// What the scene brings to its frames; nothing where its summary is missing.
  std::optional<SceneCounts> counts(const std::string& id);

  /// A worker found bytes that the id does not name: the scene is set aside.
  void setAside(const std::string& id);

  bool remove(const std::string& id);

 private:
  SceneStore(const SceneStoreOptions& options, std::optional<SceneDirectory> directory);

  SceneMemory memory_;
  std::optional<SceneDirectory> directory_;
  std::shared_ptr<LightMapDirectory> lightMaps_;
  KnownCounts counts_;
};

} // namespace gnomon
