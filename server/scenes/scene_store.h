#pragma once

#include <memory>
#include <optional>
#include <semaphore>
#include <string>
#include <vector>

#include "protocol/report/replies.h"
#include "server/scenes/light_map_directory.h"
#include "server/scenes/scene_cache.h"
#include "server/scenes/scene_directory.h"

namespace gnomon {

struct SceneStoreOptions {
  std::string directory;                ///< empty = scenes are in memory only, and the least recently used are dropped
  std::size_t memoryBytes = 2ull << 30; ///< loaded scenes that are kept
  Limits limits;                        ///< what a scene may be
  std::shared_ptr<LightMapDirectory> lightMaps{}; ///< those of a scene go with it; nullptr = there are none
};

/// The notFound problem of a route that names a scene.
Problem unknownScene(std::string_view id);

/// A scene that was put into the store.
struct StoredScene {
  LoadedScene loaded;
  bool isNew = true;
};

/// Scenes by id. A scene is loaded on the calling thread, once for all callers, and only a few at a time. Any thread.
class SceneStore {
 public:
  static Result<std::unique_ptr<SceneStore>> open(const SceneStoreOptions& options);

  /// Loads the bundle, and keeps it if it can be loaded. With `expectedId`, hashMismatch when its id is another.
  Result<StoredScene> put(const SceneBundle& bundle, const std::optional<std::string>& expectedId = std::nullopt);

  /// The loaded bundle, kept in memory as the budget allows, and never written to the directory. `id` is its bundleId.
  Result<LoadedScene> use(const std::string& id, const SceneBundle& bundle);

  /// The scene, loaded from the directory where it is not in memory.
  Result<LoadedScene> get(const std::string& id);

  bool contains(const std::string& id);

  /// What the scene holds, as stored with it; loads the scene where that is missing or of another version.
  Result<SceneSummary> summary(const std::string& id);
  SceneList summaries(); ///< of all scenes, by ascending id

  bool remove(const std::string& id);

 private:
  SceneStore(const SceneStoreOptions& options, std::optional<SceneDirectory> directory);
  Result<LoadedScene> load(const std::string& id, const SceneBundle& bundle);
  std::optional<SceneSummary> storedSummary(const std::string& id) const;

  Limits limits_;
  std::size_t memoryBytes_;
  SceneCache cache_;
  std::optional<SceneDirectory> directory_;
  std::shared_ptr<LightMapDirectory> lightMaps_;
  SingleFlight<Result<LoadedScene>> loading_;
  std::counting_semaphore<> loads_;
};

} // namespace gnomon
