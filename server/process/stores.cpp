#include "server/process/stores.h"

#include <algorithm>
#include <exception>

#include "server/jobs/local_jobs.h"
#include "server/jobs/redis_jobs.h"
#include "server/system/log.h"

namespace gnomon {
namespace {

std::shared_ptr<redis::Redis> redisAt(const redis::Address& address) {
  return std::make_shared<redis::Redis>(redis::Options{.address = address, .connections = 16});
}

/// A scene is removed when it is older than its age by less than a quarter, or than the longest period.
std::chrono::milliseconds lengthOf(const KeepingPeriod& period) {
  constexpr std::chrono::milliseconds kShortest{500};
  if (period.age.count() == 0) return period.longest;
  return std::clamp(std::chrono::milliseconds(period.age) / 4, kShortest, period.longest);
}

void keepClean(SceneStore& store, Dispatcher& workers) {
  try {
    store.keepClean([&](const std::string& id) { workers.forget(id); });
  } catch (const std::exception& error) {
    logEvent("store", error.what()); // out of memory: next time
  }
}

} // namespace

bool keepsScenesInMemory(const ServeOptions& options) {
  return options.store.empty() || redis::isAddress(options.store);
}

Result<OpenedStore> openStore(const ServeOptions& options, const std::optional<redis::Address>& address,
                              std::size_t scenesInMemory) {
  OpenedStore opened;
  SceneStoreOptions scenes{.memoryBytes = options.bundleMemoryBytes,
                           .memoryScenes = scenesInMemory,
                           .storedBytes = options.storeBytes,
                           .age = std::chrono::seconds(options.storeAgeSeconds)};
  if (address) {
    opened.redis = redisAt(*address);
    opened.lightMaps = std::make_shared<RedisLightMaps>(opened.redis, options.storedLightMapBytes);
  } else if (!options.store.empty()) {
    scenes.directory = options.store;
    opened.lightMaps = std::make_shared<LightMapDirectory>(options.store + "/light-maps", options.storedLightMapBytes);
  }
  scenes.redis = opened.redis;
  scenes.lightMaps = opened.lightMaps;
  auto store = SceneStore::open(scenes);
  if (!store) return std::move(store).problems();
  opened.scenes = *std::move(store);
  return opened;
}

std::unique_ptr<JobQueue> openJobs(const ServeOptions& options, const JobLimits& limits,
                                   const std::optional<redis::Address>& address, std::shared_ptr<redis::Redis> redis) {
  if (address) redis = redisAt(*address);
  if (redis) return std::make_unique<RedisJobs>(limits, std::move(redis));
  return std::make_unique<LocalJobs>(limits, options.store);
}

StoreKeeping::StoreKeeping(SceneStore& store, Dispatcher& workers, const KeepingPeriod& period)
    : store_(store), thread_([this, &store, &workers, length = lengthOf(period)] {
        do {
          keepClean(store, workers);
        } while (!stop_.waitFor(length));
      }) {
  store.onRemoved([&workers](const std::string& id) { workers.forget(id); });
}

StoreKeeping::~StoreKeeping() {
  store_.onRemoved(nullptr);
  stop_.raise();
  thread_.join();
}

} // namespace gnomon
