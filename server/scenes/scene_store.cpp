#include "server/scenes/scene_store.h"

#include <nlohmann/json.hpp>

#include "protocol/base/scene_id.h"
#include "protocol/json/json_codec.h"
#include "server/scenes/directory_backend.h"
#include "server/scenes/memory_backend.h"
#include "server/scenes/redis_backend.h"
#include "server/system/log.h"
#include "server/wire/bundle.h"

namespace gnomon {
namespace {

Result<std::unique_ptr<SceneBackend>> openBackend(const SceneStoreOptions& options) {
  if (!options.directory.empty()) return DirectoryBackend::open(options.directory, options.storedBytes, options.age);
  if (options.redis) {
    return std::unique_ptr<SceneBackend>(std::make_unique<RedisBackend>(
        options.redis,
        RedisBackend::Options{options.memoryBytes, options.memoryScenes, options.storedBytes, options.age}));
  }
  return std::unique_ptr<SceneBackend>(std::make_unique<MemoryBackend>(options.memoryBytes, options.memoryScenes));
}

} // namespace

SceneStore::SceneStore(const SceneStoreOptions& options, std::unique_ptr<SceneBackend> backend)
    : age_(options.age), backend_(std::move(backend)), lightMaps_(options.lightMaps) {}

Result<std::unique_ptr<SceneStore>> SceneStore::open(const SceneStoreOptions& options) {
  auto backend = openBackend(options);
  if (!backend) return std::move(backend).problems();
  return std::unique_ptr<SceneStore>(new SceneStore(options, *std::move(backend)));
}

Status SceneStore::checkRoom(std::uint64_t bytes) {
  return backend_->checkRoom(bytes);
}

Result<bool> SceneStore::put(const std::string& id, BundlePtr bundle, std::uint64_t bytes, const std::string& summary) {
  if (summary.size() > SceneBackend::kMaxSummaryBytes) {
    return Problem{ProblemCode::tooLarge, "",
                   "The scene's summary is larger than can be kept. It has fewer bytes with fewer cameras, lights and "
                   "animations, or shorter names.",
                   std::to_string(SceneBackend::kMaxSummaryBytes) + " bytes",
                   std::to_string(summary.size()) + " bytes"};
  }
  return backend_->put(id, std::move(bundle), bytes, summary);
}

Result<StoredBundle> SceneStore::bundle(const std::string& id) {
  if (!isSceneId(id)) return unknownScene(id);
  return backend_->bundle(id);
}

/// Passes on what was found. A scene that was known here, and is there no longer, was removed by another server.
Status SceneStore::reported(const std::string& id, Status found) {
  if (found || found.problems().front().code != ProblemCode::notFound || !counts_.forget(id)) return found;
  const std::lock_guard lock(telling_);
  if (listener_) listener_(id);
  return found;
}

Status SceneStore::contains(const std::string& id) {
  if (!isSceneId(id)) return unknownScene(id);
  return reported(id, backend_->contains(id));
}

Status SceneStore::use(const std::string& id) {
  if (!isSceneId(id)) return unknownScene(id);
  return reported(id, backend_->use(id));
}

std::optional<std::string> SceneStore::summary(const std::string& id) {
  auto text = backend_->summary(id);
  if (!text) return std::nullopt;
  const auto summary = decodeSceneSummary(*text);
  if (!summary || summary->id != id || jsonText(toJson(*summary)) != *text) { // damaged, or of another version
    logEvent("store", "The stored summary of scene " + id + " can't be used. The scene is loaded instead.");
    return std::nullopt;
  }
  return text;
}

std::optional<SceneCounts> SceneStore::counts(const std::string& id) {
  if (auto known = counts_.find(id)) return known;
  const auto text = summary(id);
  if (!text) return std::nullopt;
  const auto decoded = decodeSceneSummary(*text);
  if (!decoded) return std::nullopt;
  counts_.keep(id, sceneCounts(*decoded));
  return counts_.find(id);
}

Status SceneStore::remove(const std::string& id) {
  if (!isSceneId(id)) return unknownScene(id);
  Status removed = backend_->remove(id);
  if (removed && lightMaps_) lightMaps_->removeScene(id);
  return removed;
}

void SceneStore::keepClean(const SceneListener& removed) {
  backend_->keepClean([&](const std::string& id) {
    if (lightMaps_) lightMaps_->removeScene(id);
    logEvent("store", "Scene " + id + " is removed: it was not used for " + std::to_string(age_.count()) + " s.");
    removed(id);
  });
  if (lightMaps_) lightMaps_->cleanUp();
}

void SceneStore::onRemoved(SceneListener listener) {
  backend_->onRemoved(listener);
  const std::lock_guard lock(telling_);
  listener_ = std::move(listener);
}

} // namespace gnomon
