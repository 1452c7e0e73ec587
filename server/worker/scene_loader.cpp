#include "server/worker/scene_loader.h"

#include <limits>
#include <malloc.h>
#include <numeric>

#include "server/wire/bundle.h"

namespace gnomon {
namespace {

bool isBundleOf(const std::string& id, std::span<const std::uint8_t> bytes) {
  Sha256 hash;
  hash.add(bytes);
  return hash.hex() == id;
}

const std::string& idOf(const LoadedScene& loaded) {
  return loaded.summary.id;
}

std::uint64_t bytesOf(const LoadedScene& loaded) {
  return loaded.summary.memoryBytes;
}

} // namespace

std::optional<LoadedScene> SceneCache::get(const std::string& id) {
  const std::lock_guard lock(mutex_);
  const LoadedScene* const found = scenes_.find(id, idOf);
  return found ? std::optional(*found) : std::nullopt;
}

void SceneCache::put(LoadedScene loaded) {
  const std::lock_guard lock(mutex_);
  if (scenes_.find(loaded.summary.id, idOf)) return;
  scenes_.add(std::move(loaded));
  scenes_.keepWithin(budget_, bytesOf);
}

bool SceneCache::remove(const std::string& id) {
  const std::lock_guard lock(mutex_);
  return scenes_.eraseIf([&](const LoadedScene& loaded) { return idOf(loaded) == id; }) > 0;
}

std::size_t SceneCache::bytes() const {
  const std::lock_guard lock(mutex_);
  return std::transform_reduce(scenes_.begin(), scenes_.end(), std::size_t{0}, std::plus<>(), bytesOf);
}

std::size_t SceneCache::count() const {
  const std::lock_guard lock(mutex_);
  return scenes_.size();
}

std::variant<LoadedScene, LoadFailure> SceneLoader::load(const std::string& id, const BundleFile& bundle,
                                                         const GoOn& goOn) {
  auto bytes = readFile(bundle.file, std::numeric_limits<std::size_t>::max()); // the front has bounded it
  if (!bytes) return LoadFailure{{{ProblemCode::unavailable, "", "The scene's bytes could not be read.", "", ""}}};
  const std::size_t size = bytes->size();
  if (bundle.isStored && !isBundleOf(id, *bytes)) return LoadFailure{{}, true};
  auto read = readBundle(*std::move(bytes), limits_);
  if (!read) return LoadFailure{std::move(read).problems()};
  read->strict = bundle.strict;
  auto scene = loadScene(*read, limits_, id, goOn, &known_);
  if (!scene) return LoadFailure{std::move(scene).problems()};
  LoadedScene loaded{*scene, summaryOf(**scene)};
  loaded.summary.id = id;
  loaded.summary.bytes = size;
  if (loaded.summary.memoryBytes > most_) {
    return LoadFailure{{{ProblemCode::tooLarge, "", "The loaded scene is larger than a worker's memory for scenes.",
                         std::to_string(most_) + " bytes", std::to_string(loaded.summary.memoryBytes) + " bytes"}}};
  }
  return loaded;
}

std::variant<LoadedScene, LoadFailure> SceneLoader::get(const std::string& id, const BundleFile& bundle,
                                                        const GoOn& goOn) {
  if (bundle.strict) { // loaded again, as a cached scene may have been repaired
    auto loaded = load(id, bundle, goOn);
    if (const auto* scene = std::get_if<LoadedScene>(&loaded)) cache_.put(*scene);
    return loaded;
  }
  while (true) {
    if (auto known = cache_.get(id)) return *std::move(known);
    bool isOwn = false;
    const auto loadNow = [&]() -> std::variant<LoadedScene, LoadFailure> {
      isOwn = true;
      if (auto known = cache_.get(id)) return *std::move(known); // loaded by another call meanwhile
      auto loaded = load(id, bundle, goOn);
      if (const auto* scene = std::get_if<LoadedScene>(&loaded)) cache_.put(*scene);
      malloc_trim(0); // what a load leaves free in the heaps goes back to the system
      return loaded;
    };
    auto result = loading_.run(id, loadNow, goOn);
    if (!result) return LoadFailure{{stoppedProblem()}};
    const auto* failure = std::get_if<LoadFailure>(&*result);
    const bool otherStopped = failure != nullptr && !isOwn && !failure->problems.empty() &&
                              failure->problems.front().code == ProblemCode::unavailable;
    if (!otherStopped || (goOn && !goOn())) return *std::move(result);
  }
}

void SceneLoader::forget(const std::string& id) {
  if (cache_.remove(id)) malloc_trim(0);
}

} // namespace gnomon
