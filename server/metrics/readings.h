#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <prometheus/metric_family.h>
#include <vector>

#include "protocol/report/replies.h"
#include "server/dispatch/dispatcher.h"
#include "server/frames/reply_cache.h"
#include "server/jobs/job_queue.h"
#include "server/scenes/scene_memory.h"

namespace gnomon::metrics {

/// What this process takes, by proc(5); 0 where that is unknown.
struct ProcessUse {
  std::uint64_t residentBytes = 0;
  std::uint64_t virtualBytes = 0;
  std::uint64_t openFiles = 0; ///< descriptors
  std::uint64_t mostFiles = 0; ///< descriptors that it may have
  std::uint64_t threads = 0;
  double processorSeconds = 0; ///< user and system, of all its threads
  double startSeconds = 0;     ///< since 1970
};

ProcessUse processUse();

/// Bytes of a budget.
struct BudgetUse {
  std::size_t used = 0;
  std::size_t limit = 0;
};

/// What the server is like at one moment.
struct Snapshot {
  DispatcherState workers;
  std::uint64_t workerBytes = 0; ///< memory of all workers
  std::size_t requestsInProgress = 0;
  std::size_t threads = 0; ///< requests that may be in progress
  BudgetUse uploads;
  BudgetUse replies;
  CacheUse cache;
  std::size_t cacheLimit = 0; ///< bytes
  std::uint64_t framesShared = 0;
  StoreSize store;
  StoreState storeState;
  std::optional<JobsSize> jobs;                                 ///< nothing while the queue can't be reached
  std::array<std::uint64_t, kFrameEndNames.size()> jobFrames{}; ///< that this server took, by FrameEnd
  std::uint64_t logLinesDropped = 0;
  bool draining = false;
  ProcessUse process;
  std::string version;
  RendererInfo renderer;
};

/// Its metrics, by one table.
std::vector<prometheus::MetricFamily> readingsOf(const Snapshot& snapshot);

} // namespace gnomon::metrics
