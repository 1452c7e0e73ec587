#pragma once

#include <chrono>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "protocol/base/lru.h"
#include "protocol/base/result.h"
#include "protocol/cost/frame_cost.h"
#include "server/redis/redis.h"
#include "server/scenes/scene_backend.h"
#include "server/scenes/stored_light_maps.h"

namespace gnomon {

/// What scenes bring to their frames, by id, as it was last read from their summaries; the longest unused are
/// forgotten. Any thread.
class KnownCounts {
 public:
  std::optional<SceneCounts> find(const std::string& id);
  void keep(const std::string& id, SceneCounts counts);
  bool forget(const std::string& id); ///< false where it was not known

 private:
  static constexpr std::size_t kMost = 1024;       ///< scenes, a few kilobytes each at most
  static constexpr std::size_t kMostLights = 1024; ///< more than a frame may have

  using Entry = std::pair<std::string, SceneCounts>;

  std::mutex mutex_;
  LruList<Entry> entries_;
};

struct SceneStoreOptions {
  std::string directory{};                      ///< where scenes are kept; empty = in Redis, or in memory only
  std::size_t memoryBytes = 1ull << 30;         ///< of bundles in memory, where no directory keeps them
  std::size_t memoryScenes = 4'096;             ///< and as many of them at most: each has a descriptor
  std::uint64_t storedBytes = 0;                ///< of bundles in the directory or in Redis; 0 = as many as that takes
  std::chrono::seconds age{};                   ///< scenes not used for so long go; 0 = never
  std::shared_ptr<redis::Redis> redis{};        ///< nullptr = none
  std::shared_ptr<StoredLightMaps> lightMaps{}; ///< those of a scene go with it; nullptr = there are none
};

/// Scenes by id: their bundles, and the summaries that workers made of them. Nothing here reads a scene. Any thread.
///
/// Where a directory or Redis keeps the scenes, each call may have the problem unavailable.
class SceneStore {
 public:
  static Result<std::unique_ptr<SceneStore>> open(const SceneStoreOptions& options);

  /// insufficientStorage where a bundle of so many bytes has no room now.
  Status checkRoom(std::uint64_t bytes);

  /// Keeps a scene that a worker could load. False where it is there already, and marks it as used. `bytes`: of the
  /// bundle. Problems: insufficientStorage, and tooLarge where the summary is.
  Result<bool> put(const std::string& id, BundlePtr bundle, std::uint64_t bytes, const std::string& summary);

  Result<StoredBundle> bundle(const std::string& id); ///< or notFound

  Status contains(const std::string& id); ///< or notFound
  Status use(const std::string& id);      ///< the same, and marks the scene as used now

  /// `limit` ids behind `after`, ascending.
  Result<ScenePage> page(std::string_view after, std::size_t limit) { return backend_->page(after, limit); }

  StoreSize size() { return backend_->size(); }
  StoreState state() { return backend_->state(); }

  /// What the scene holds, as JSON; nothing where it is missing, damaged, or of another version.
  std::optional<std::string> summary(const std::string& id);
  void keepSummary(const std::string& id, const std::string& summary) { backend_->keepSummary(id, summary); }

  /// What the scene brings to its frames; nothing where its summary is missing.
  std::optional<SceneCounts> counts(const std::string& id);

  /// A worker found bytes that the id does not name: the scene is set aside.
  void setAside(const std::string& id) { backend_->setAside(id); }

  Status remove(const std::string& id); ///< or notFound

  /// Removes what was not used for the age of the options, reporting each scene, and what servers that died have left.
  /// To be called ever so often, by one thread.
  void keepClean(const SceneListener& removed);

  /// From now on `listener` gets each scene that another server removed: at once, or when it is asked for next. nullptr
  /// = none. Any thread may call it, until the next call of this has returned.
  void onRemoved(SceneListener listener);

 private:
  SceneStore(const SceneStoreOptions& options, std::unique_ptr<SceneBackend> backend);
  Status reported(const std::string& id, Status found);

  const std::chrono::seconds age_;
  const std::unique_ptr<SceneBackend> backend_;
  const std::shared_ptr<StoredLightMaps> lightMaps_;
  KnownCounts counts_;
  std::mutex telling_;
  SceneListener listener_;
};

} // namespace gnomon
