#include "server/scenes/scene_store.h"

#include <nlohmann/json.hpp>

#include "protocol/base/scene_bundle.h"
#include "protocol/base/text.h"
#include "protocol/json/json_codec.h"
#include "server/scenes/directory_backend.h"
#include "server/scenes/redis_backend.h"
#include "server/scenes/scene_memory.h"
#include "server/system/log.h"
#include "server/wire/bundle.h"

namespace gnomon {
namespace {

/// Scenes that this process alone keeps, the least recently used dropped first.
class MemoryBackend : public SceneBackend {
 public:
  MemoryBackend(std::size_t budgetBytes, std::size_t most) : scenes_(budgetBytes, most) {}

  Status checkRoom(std::uint64_t) override { return Done{}; }
  Result<bool> put(const std::string& id, BundlePtr bundle, std::uint64_t bytes, const std::string& summary) override {
    return scenes_.put(id, std::move(bundle), bytes, summary);
  }
  Result<StoredBundle> bundle(const std::string& id) override {
    BundlePtr file = scenes_.bundle(id);
    if (!file) return unknownScene(id);
    return StoredBundle{std::move(file), false};
  }
  Status contains(const std::string& id) override { return found(id, scenes_.contains(id)); }
  Status use(const std::string& id) override { return found(id, scenes_.bundle(id) != nullptr); }
  Result<ScenePage> page(std::string_view after, std::size_t limit) override { return scenes_.page(after, limit); }
  StoreSize size() override { return scenes_.size(); }
  std::optional<std::string> summary(const std::string& id) override { return scenes_.summary(id); }
  void keepSummary(const std::string&, const std::string&) override {} ///< none is ever missing
  void setAside(const std::string&) override {}                        ///< bytes in memory are not damaged
  Status remove(const std::string& id) override { return found(id, scenes_.remove(id)); }
  void keepClean(const SceneListener&) override {}
  void onRemoved(SceneListener) override {} ///< this process alone removes any

 private:
  static Status found(const std::string& id, bool isThere) {
    if (!isThere) return unknownScene(id);
    return Done{};
  }

  SceneMemory scenes_;
};

Result<std::unique_ptr<SceneBackend>> openBackend(const SceneStoreOptions& options) {
  if (!options.directory.empty()) return openSceneDirectory(options.directory, options.storedBytes, options.age);
  if (options.redis) {
    return std::unique_ptr<SceneBackend>(std::make_unique<RedisBackend>(
        options.redis,
        RedisBackend::Options{options.memoryBytes, options.memoryScenes, options.storedBytes, options.age}));
  }
  return std::unique_ptr<SceneBackend>(std::make_unique<MemoryBackend>(options.memoryBytes, options.memoryScenes));
}

} // namespace

Problem unknownScene(std::string_view id) {
  return {ProblemCode::notFound, "id", "No scene with this id is stored.", "", asciiExcerpt(id)};
}

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

std::optional<SceneCounts> KnownCounts::find(const std::string& id) {
  const std::lock_guard lock(mutex_);
  const Entry* const known = entries_.find(id, &Entry::first);
  return known ? std::optional(known->second) : std::nullopt;
}

void KnownCounts::keep(const std::string& id, SceneCounts counts) {
  if (counts.lights.size() > kMostLights) counts.lights.resize(kMostLights);
  const std::lock_guard lock(mutex_);
  entries_.add({id, std::move(counts)});
  entries_.keepNewest(kMost);
}

bool KnownCounts::forget(const std::string& id) {
  const std::lock_guard lock(mutex_);
  return entries_.eraseIf([&](const Entry& entry) { return entry.first == id; }) > 0;
}

} // namespace gnomon
