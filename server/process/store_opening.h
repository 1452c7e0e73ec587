#pragma once

#include <memory>

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

/// Opens the store. Redis may be away then. `scenesInMemory`: at most, where any are.
Result<OpenedStore> openStore(const ServeOptions& options, std::size_t scenesInMemory);

/// Opens the queue of jobs: that of --jobs, else in the store's Redis, where it is one, else of this process.
Result<std::unique_ptr<JobQueue>> openJobs(const ServeOptions& options, const JobLimits& limits,
                                           std::shared_ptr<redis::Redis> redis);

} // namespace gnomon
