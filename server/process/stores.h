#pragma once

#include <memory>
#include <optional>
#include <thread>

#include "server/dispatch/dispatcher.h"
#include "server/jobs/job_queue.h"
#include "server/process/serve.h"
#include "server/redis/redis.h"
#include "server/scenes/scene_store.h"
#include "server/scenes/stored_light_maps.h"

namespace gnomon {

/// Where scenes are kept, by the options.
struct OpenedStore {
  std::shared_ptr<redis::Redis> redis{};        ///< nullptr where the store is none of Redis
  std::shared_ptr<StoredLightMaps> lightMaps{}; ///< nullptr where it is memory alone
  std::unique_ptr<SceneStore> scenes;
};

/// Whether scenes are in the memory of this process: all of them, or the last ones that were used.
bool keepsScenesInMemory(const ServeOptions& options);

/// Opens the store: in Redis at `address`, where there is one, else in the directory that the options name, or in
/// memory. Redis may be away then. `scenesInMemory`: at most, where any are.
Result<OpenedStore> openStore(const ServeOptions& options, const std::optional<redis::Address>& address,
                              std::size_t scenesInMemory);

/// Opens the queue of jobs: in Redis at `address`, else in the store's Redis, where it is one, else of this process.
std::unique_ptr<JobQueue> openJobs(const ServeOptions& options, const JobLimits& limits,
                                   const std::optional<redis::Address>& address, std::shared_ptr<redis::Redis> redis);

/// How often a store is kept clean.
struct KeepingPeriod {
  std::chrono::seconds age{};                                  ///< that of the store's options; 0 = scenes do not age
  std::chrono::milliseconds longest = std::chrono::minutes(1); ///< between two times
};

/// Keeps a store clean for as long as it exists: ever so often removes what is too old, and what servers that died have
/// left. Workers forget what is removed, by this server or another.
class StoreKeeping {
 public:
  /// Store and workers outlive it.
  StoreKeeping(SceneStore& store, Dispatcher& workers, const KeepingPeriod& period);
  ~StoreKeeping();

 private:
  SceneStore& store_;
  StopSignal stop_;
  std::thread thread_;
};

} // namespace gnomon
