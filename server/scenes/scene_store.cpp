#include "server/scenes/scene_store.h"

#include <malloc.h>
#include <nlohmann/json.hpp>

#include "protocol/base/text.h"
#include "protocol/json/json_codec.h"
#include "server/http/reply.h"
#include "server/http/request_log.h"
#include "server/scenes/bundle.h"

namespace gnomon {
namespace {

constexpr int kLoadsAtOnce = 2; ///< a load may need many times the memory of its file

std::string summaryText(const SceneSummary& summary) {
  return jsonText(toJson(summary));
}

/// A permit to load, released however the load ends. Free memory then goes back to the system: the allocator keeps a
/// heap for each thread, and what many loads leave free in all of them adds up.
class LoadPermit {
 public:
  explicit LoadPermit(std::counting_semaphore<>& permits) : permits_(permits) { permits_.acquire(); }
  ~LoadPermit() {
    malloc_trim(0);
    permits_.release();
  }
  LoadPermit(const LoadPermit&) = delete;
  LoadPermit& operator=(const LoadPermit&) = delete;

 private:
  std::counting_semaphore<>& permits_;
};

} // namespace

Problem unknownScene(std::string_view id) {
  return {ProblemCode::notFound, "id", "No scene with this id is stored.", "", asciiExcerpt(id)};
}

SceneStore::SceneStore(const SceneStoreOptions& options, std::optional<SceneDirectory> directory)
    : limits_(options.limits),
      memoryBytes_(options.memoryBytes),
      cache_(options.memoryBytes),
      directory_(std::move(directory)),
      lightMaps_(options.lightMaps),
      loads_(kLoadsAtOnce) {}

Result<std::unique_ptr<SceneStore>> SceneStore::open(const SceneStoreOptions& options) {
  std::optional<SceneDirectory> directory;
  if (!options.directory.empty()) {
    auto opened = SceneDirectory::open(options.directory, options.limits.maxSceneBytes);
    if (!opened) {
      return std::move(opened).problems();
    }
    directory = *std::move(opened);
  }
  return std::unique_ptr<SceneStore>(new SceneStore(options, std::move(directory)));
}

Result<LoadedScene> SceneStore::load(const std::string& id, const SceneBundle& bundle) {
  const LoadPermit permit(loads_);
  auto scene = loadScene(bundle, limits_, id);
  if (!scene) {
    return std::move(scene).problems();
  }
  LoadedScene loaded{*scene, summaryOf(**scene)};
  loaded.summary.id = id;
  loaded.summary.bytes = bundleBytes(bundle);
  if (loaded.summary.memoryBytes > memoryBytes_) {
    return Problem{ProblemCode::tooLarge, "", "The loaded scene is larger than the memory for scenes.",
                   std::to_string(memoryBytes_) + " bytes", std::to_string(loaded.summary.memoryBytes) + " bytes"};
  }
  return loaded;
}

Result<StoredScene> SceneStore::put(const SceneBundle& bundle, const std::optional<std::string>& expectedId) {
  const std::string id = bundleId(bundle);
  if (expectedId && *expectedId != id) {
    return Problem{ProblemCode::hashMismatch, "", "The SHA-256 of the uploaded bytes is not the one in the path.",
                   *expectedId, id};
  }
  bool isNew = false;
  auto loaded = loading_.run("put " + id, [&]() -> Result<LoadedScene> {
    const bool stored = directory_ && directory_->contains(id);
    auto known = cache_.get(id);
    isNew = directory_ ? !stored : !known;
    if (!known) {
      auto fresh = load(id, bundle);
      if (!fresh) {
        return fresh;
      }
      known = *std::move(fresh);
    }
    if (directory_ && !stored) {
      if (auto written = directory_->write(id, bundle, summaryText(known->summary)); !written) {
        return std::move(written).problems();
      }
    }
    cache_.put(*known);
    return *std::move(known);
  });
  if (!loaded) {
    return std::move(loaded).problems();
  }
  return StoredScene{*std::move(loaded), isNew};
}

Result<LoadedScene> SceneStore::use(const std::string& id, const SceneBundle& bundle) {
  if (auto known = cache_.get(id)) {
    return *std::move(known);
  }
  return loading_.run("use " + id, [&] {
    auto loaded = load(id, bundle);
    if (loaded) {
      cache_.put(*loaded);
    }
    return loaded;
  });
}

Result<LoadedScene> SceneStore::get(const std::string& id) {
  if (auto known = cache_.get(id)) {
    return *std::move(known);
  }
  if (!directory_ || !isSceneId(id)) {
    return unknownScene(id);
  }
  return loading_.run("get " + id, [&]() -> Result<LoadedScene> {
    if (auto known = cache_.get(id)) { // loaded by another call meanwhile
      return *std::move(known);
    }
    auto bundle = directory_->read(id);
    if (!bundle) {
      return std::move(bundle).problems();
    }
    auto loaded = load(id, *bundle);
    if (loaded) {
      cache_.put(*loaded);
    }
    return loaded;
  });
}

bool SceneStore::contains(const std::string& id) {
  return isSceneId(id) && (cache_.get(id) || (directory_ && directory_->contains(id)));
}

std::optional<SceneSummary> SceneStore::storedSummary(const std::string& id) const {
  const auto text = directory_->readSummary(id);
  if (!text) {
    return std::nullopt;
  }
  auto summary = decodeSceneSummary(*text);
  if (!summary || summary->id != id || summaryText(*summary) != *text) { // damaged, or written by another version
    logEvent("store", "The stored summary of scene " + id + " can't be used. The scene is loaded instead.");
    return std::nullopt;
  }
  return *std::move(summary);
}

Result<SceneSummary> SceneStore::summary(const std::string& id) {
  if (!contains(id)) {
    return unknownScene(id);
  }
  if (auto known = cache_.get(id)) {
    return std::move(known->summary);
  }
  if (auto stored = storedSummary(id)) {
    return *std::move(stored);
  }
  auto loaded = get(id);
  if (!loaded) {
    return std::move(loaded).problems();
  }
  directory_->writeSummary(id, summaryText(loaded->summary));
  return std::move(loaded->summary);
}

SceneList SceneStore::summaries() {
  if (!directory_) {
    return {cache_.summaries()};
  }
  SceneList all;
  for (const std::string& id : directory_->ids()) {
    if (auto found = summary(id)) {
      all.scenes.push_back(*std::move(found));
    }
  }
  return all;
}

bool SceneStore::remove(const std::string& id) {
  if (!isSceneId(id)) {
    return false;
  }
  const bool fromMemory = cache_.remove(id);
  if (fromMemory) malloc_trim(0); // as after a load
  const bool fromDisk = directory_ && directory_->remove(id);
  if (lightMaps_) lightMaps_->removeScene(id);
  return fromMemory || fromDisk;
}

} // namespace gnomon
