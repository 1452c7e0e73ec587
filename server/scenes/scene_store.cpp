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
    : memory_(options.memoryBytes), directory_(std::move(directory)), lightMaps_(options.lightMaps) {}

Result<std::unique_ptr<SceneStore>> SceneStore::open(const SceneStoreOptions& options) {
  std::optional<SceneDirectory> directory;
  if (!options.directory.empty()) {
    auto opened = SceneDirectory::open(options.directory);
    if (!opened) return std::move(opened).problems();
    directory = *std::move(opened);
  }
  return std::unique_ptr<SceneStore>(new SceneStore(options, std::move(directory)));
}

Result<bool> SceneStore::put(const std::string& id, BundlePtr bundle, std::uint64_t bytes, const std::string& summary) {
  if (!directory_) return memory_.put(id, std::move(bundle), bytes, summary);
  if (directory_->contains(id)) return false;
  if (auto written = directory_->write(id, *bundle, summary); !written) return std::move(written).problems();
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

bool SceneStore::contains(const std::string& id) {
  return isSceneId(id) && (directory_ ? directory_->contains(id) : memory_.bundle(id) != nullptr);
}

std::vector<std::string> SceneStore::ids() {
  return directory_ ? directory_->ids() : memory_.ids();
}

StoreUse SceneStore::use() const {
  return directory_ ? directory_->use() : memory_.use();
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
  const bool removed = directory_ ? directory_->remove(id) : memory_.remove(id);
  if (removed && lightMaps_) lightMaps_->removeScene(id);
  return removed;
}

} // namespace gnomon
