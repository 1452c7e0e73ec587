#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "protocol/base/result.h"
#include "server/scenes/known_counts.h"
#include "server/scenes/light_map_directory.h"
#include "server/scenes/scene_directory.h"
#include "server/scenes/scene_memory.h"
#include "server/scenes/store_quota.h"

namespace gnomon {

struct SceneStoreOptions {
  std::string directory{};              ///< empty = scenes are in memory only, and the least recently used are dropped
  std::size_t memoryBytes = 1ull << 30; ///< of their bundles, where there is no directory
  std::size_t memoryScenes = 4'096;     ///< and as many of them at most: each has a descriptor
  std::uint64_t directoryBytes = 0;     ///< of their bundles, where there is one; 0 = as many as the disk takes
  std::chrono::seconds age{};           ///< scenes of a directory that nobody used for so long go; 0 = never
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

  /// insufficientStorage where a bundle of so many bytes has no room now, by the directory's quota.
  Status checkRoom(std::uint64_t bytes);

  /// Keeps a scene that a worker could load. False where it is there already, and marks it as used. `bytes`: of the
  /// bundle. Problems: insufficientStorage, unavailable where the disk refuses, tooLarge where the summary is.
  Result<bool> put(const std::string& id, BundlePtr bundle, std::uint64_t bytes, const std::string& summary);

  /// notFound, or unavailable where the disk refuses.
  Result<StoredBundle> bundle(const std::string& id);

  bool contains(const std::string& id) const;

  /// The same, and marks the scene as used now.
  bool use(const std::string& id);

  /// `limit` ids behind `after`, ascending.
  ScenePage page(std::string_view after, std::size_t limit) const;

  StoreSize size() const;

  /// What the scene holds, as JSON; nothing where it is missing, damaged, or of another version.
  std::optional<std::string> summary(const std::string& id) const;
  void keepSummary(const std::string& id, const std::string& summary);

  /// What the scene brings to its frames; nothing where its summary is missing.
  std::optional<SceneCounts> counts(const std::string& id);

  /// A worker found bytes that the id does not name: the scene is set aside.
  void setAside(const std::string& id);

  bool remove(const std::string& id);

  /// Removes what nobody used for the age of the options, telling each scene, and what servers that died have left. To
  /// be called ever so often, by one thread.
  void keepClean(const std::function<void(const std::string& id)>& removed);

 private:
  SceneStore(const SceneStoreOptions& options, std::optional<SceneDirectory> directory);

  const std::chrono::seconds age_;
  SceneMemory memory_;
  std::optional<SceneDirectory> directory_;
  StoreQuota quota_;
  std::shared_ptr<LightMapDirectory> lightMaps_;
  KnownCounts counts_;
};

} // namespace gnomon
