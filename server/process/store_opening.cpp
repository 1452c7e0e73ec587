#include "server/process/store_opening.h"

#include "server/scenes/light_map_directory.h"
#include "server/scenes/redis_light_maps.h"

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
  if (!redis::isAddress(options.store) && !(options.redisPasswordFile.empty() && options.redisAuthorities.empty())) {
    return refused("--redis-password-file and --redis-authorities need a --store that is Redis.");
  }
  return std::nullopt;
}

Result<redis::Address> addressOf(const ServeOptions& options) {
  auto address = redis::parseAddress(options.store);
  if (!address) return address;
  if (!options.redisPasswordFile.empty()) {
    if (!address->password.empty()) return refused("--store has a password, and --redis-password-file, too.");
    auto password = redis::passwordFrom(options.redisPasswordFile);
    if (!password) return std::move(password).problems();
    address->password = *std::move(password);
  }
  if (!options.redisAuthorities.empty() && !address->isEncrypted) {
    return refused("--redis-authorities is about TLS: --store has to begin with rediss://.");
  }
  address->authorities = options.redisAuthorities;
  return address;
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
    auto address = addressOf(options);
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

} // namespace gnomon
