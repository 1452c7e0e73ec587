#include "server/process/stores.h"

#include <algorithm>
#include <exception>

#include "server/jobs/local_jobs.h"
#include "server/jobs/redis_jobs.h"
#include "server/system/log.h"

namespace gnomon {
namespace {

Problem refused(std::string detail, std::string actual = "") {
  return {ProblemCode::invalidValue, "", std::move(detail), "", std::move(actual)};
}

/// What contradicts itself; nothing where all is well.
std::optional<Problem> contradiction(const ServeOptions& options) {
  if (options.store.empty() && (options.storeBytes > 0 || options.storeAgeSeconds > 0)) {
    return refused(
        "--store-bytes and --store-age are about scenes that are stored: --store has to name a directory or "
        "Redis.");
  }
  const bool isRedis = redis::isAddress(options.store) || !options.jobsAddress.empty();
  if (!isRedis && !(options.redisPasswordFile.empty() && options.redisAuthorities.empty())) {
    return refused("--redis-password-file and --redis-authorities need a --store or --jobs that is Redis.");
  }
  if (!options.jobsAddress.empty() && options.store.empty()) {
    return refused("Jobs of --jobs are drawn by every server that names it: --store has to name what they share.");
  }
  return std::nullopt;
}

/// `flag` has the text.
Result<redis::Address> addressOf(const ServeOptions& options, const std::string& flag, const std::string& text) {
  auto address = redis::parseAddress(text);
  if (!address) return address;
  if (!options.redisPasswordFile.empty()) {
    if (!address->password.empty()) return refused(flag + " has a password, and --redis-password-file, too.");
    auto password = redis::passwordFrom(options.redisPasswordFile);
    if (!password) return std::move(password).problems();
    address->password = *std::move(password);
  }
  if (!options.redisAuthorities.empty() && !address->isEncrypted) {
    return refused("--redis-authorities is about TLS: " + flag + " has to begin with rediss://.");
  }
  address->authorities = options.redisAuthorities;
  return address;
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

Result<OpenedStore> openStore(const ServeOptions& options, std::size_t scenesInMemory) {
  if (auto problem = contradiction(options)) return *std::move(problem);
  OpenedStore opened;
  SceneStoreOptions scenes{.memoryBytes = options.bundleMemoryBytes,
                           .memoryScenes = scenesInMemory,
                           .storedBytes = options.storeBytes,
                           .age = std::chrono::seconds(options.storeAgeSeconds)};
  if (redis::isAddress(options.store)) {
    auto address = addressOf(options, "--store", options.store);
    if (!address) return std::move(address).problems();
    opened.redis = std::make_shared<redis::Redis>(redis::Options{.address = *std::move(address), .connections = 16});
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

Result<std::unique_ptr<JobQueue>> openJobs(const ServeOptions& options, const JobLimits& limits,
                                           std::shared_ptr<redis::Redis> redis) {
  if (!options.jobsAddress.empty()) {
    auto address = addressOf(options, "--jobs", options.jobsAddress);
    if (!address) return std::move(address).problems();
    redis = std::make_shared<redis::Redis>(redis::Options{.address = *std::move(address), .connections = 16});
  }
  std::unique_ptr<JobQueue> queue;
  if (redis) {
    queue = std::make_unique<RedisJobs>(limits, std::move(redis));
  } else {
    queue = std::make_unique<LocalJobs>(limits, options.store);
  }
  return queue;
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
