#include "server/scenes/scene_store.h"

#include <nlohmann/json.hpp>

#include "protocol/base/text.h"
#include "protocol/json/json_codec.h"
#include "server/system/log.h"
#include "server/wire/bundle.h"

namespace gnomon {

Problem unknownScene(std::string_view id) {
  return {ProblemCode::notFound, "id", "No scene with this id is stored.", "", asciiExcerpt(id)};
}

SceneStore::SceneStore(const SceneStoreOptions& options, std::optional<SceneDirectory> directory)
    : age_(options.age),
      memory_(options.memoryBytes, options.memoryScenes),
      directory_(std::move(directory)),
      quota_(directory_ ? options.directoryBytes : 0, [this] { return directory_->size().bytes; }),
      lightMaps_(options.lightMaps) {}

Result<std::unique_ptr<SceneStore>> SceneStore::open(const SceneStoreOptions& options) {
  std::optional<SceneDirectory> directory;
  if (!options.directory.empty()) {
    auto opened = SceneDirectory::open(options.directory, options.age);
    if (!opened) return std::move(opened).problems();
    directory = *std::move(opened);
  }
  return std::unique_ptr<SceneStore>(new SceneStore(options, std::move(directory)));
}

Status SceneStore::checkRoom(std::uint64_t bytes) {
  return quota_.check(bytes);
}

Result<bool> SceneStore::put(const std::string& id, BundlePtr bundle, std::uint64_t bytes, const std::string& summary) {
  if (summary.size() > SceneDirectory::kMaxSummaryBytes) {
    return Problem{ProblemCode::tooLarge, "",
                   "The scene's summary is larger than can be kept. It has fewer bytes with fewer cameras, lights and "
                   "animations, or shorter names.",
                   std::to_string(SceneDirectory::kMaxSummaryBytes) + " bytes",
                   std::to_string(summary.size()) + " bytes"};
  }
  if (!directory_) return memory_.put(id, std::move(bundle), bytes, summary);
  if (use(id)) return false;
  const Status written = quota_.write(bytes, [&] { return directory_->write(id, *bundle, summary); });
  if (!written) return written.problems();
  return true;
}

Result<StoredBundle> SceneStore::bundle(const std::string& id) {
  if (!isSceneId(id)) return unknownScene(id);
  if (!directory_) {
    BundlePtr file = memory_.bundle(id);
    if (!file) return unknownScene(id);
    return StoredBundle{std::move(file), false};
  }
  auto file = std::make_shared<FileDescriptor>(directory_->openBundle(id));
  if (*file) return StoredBundle{std::move(file), true};
  if (!directory_->contains(id)) return unknownScene(id);
  return Problem{ProblemCode::unavailable, "", "The scene store can't read its disk.", "", ""};
}

bool SceneStore::contains(const std::string& id) const {
  return isSceneId(id) && (directory_ ? directory_->contains(id) : memory_.contains(id));
}

bool SceneStore::use(const std::string& id) {
  if (!isSceneId(id)) return false;
  return directory_ ? static_cast<bool>(directory_->openBundle(id)) : memory_.bundle(id) != nullptr;
}

ScenePage SceneStore::page(std::string_view after, std::size_t limit) const {
  return directory_ ? directory_->page(after, limit) : memory_.page(after, limit);
}

StoreSize SceneStore::size() const {
  return directory_ ? directory_->size() : memory_.size();
}

std::optional<std::string> SceneStore::summary(const std::string& id) const {
  if (!directory_) return memory_.summary(id);
  auto text = directory_->readSummary(id);
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
  const auto decoded = text ? decodeSceneSummary(*text) : Result<SceneSummary>(Problems{});
  if (!decoded) return std::nullopt;
  counts_.keep(id, sceneCounts(*decoded));
  return counts_.find(id);
}

void SceneStore::keepSummary(const std::string& id, const std::string& summary) {
  if (directory_) directory_->writeSummary(id, summary);
}

void SceneStore::setAside(const std::string& id) {
  if (directory_) directory_->setAside(id);
}

bool SceneStore::remove(const std::string& id) {
  if (!isSceneId(id)) return false;
  const std::uint64_t bytes = directory_ ? directory_->bytesOf(id) : 0;
  const bool removed = directory_ ? directory_->remove(id) : memory_.remove(id);
  if (removed) quota_.giveBack(bytes);
  if (removed && lightMaps_) lightMaps_->removeScene(id);
  return removed;
}

void SceneStore::keepClean(const std::function<void(const std::string& id)>& removed) {
  if (!directory_) return;
  directory_->cleanUp();
  if (lightMaps_) lightMaps_->cleanUp();
  if (age_.count() == 0) return;
  directory_->removeUnused(age_, [&](const std::string& id) {
    if (lightMaps_) lightMaps_->removeScene(id);
    logEvent("store", "Scene " + id + " is removed: nobody has used it for " + std::to_string(age_.count()) + " s.");
    removed(id);
  });
}

} // namespace gnomon
