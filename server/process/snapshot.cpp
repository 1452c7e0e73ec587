#include "server/process/snapshot.h"

#include <algorithm>

#include "server/system/log.h"

namespace gnomon {

metrics::Snapshot snapshotOf(const ServeOptions& options, Services& services, const ConnectionContext& context) {
  const auto jobs = services.jobs.size();
  std::array<std::uint64_t, kFrameEndNames.size()> jobFrames{};
  std::copy(services.jobFrames.ends.begin(), services.jobFrames.ends.end(), jobFrames.begin());
  return {.workers = services.workers.state(),
          .workerBytes = services.workers.residentBytes(),
          .requestsInProgress = context.inProgress,
          .threads = options.httpThreads,
          .uploads = {context.bodyBytes.used(), context.bodyBytes.total()},
          .replies = {context.replyBytes.used(), context.replyBytes.total()},
          .cache = services.replies.use(),
          .cacheLimit = options.replyCacheBytes,
          .framesShared = services.shared.shared(),
          .store = services.store.size(),
          .storeState = services.store.state(),
          .jobs = jobs ? std::optional(*jobs) : std::nullopt,
          .jobFrames = jobFrames,
          .logLinesDropped = logLinesDropped(),
          .draining = services.draining,
          .process = metrics::processUse(),
          .version = GNOMON_VERSION,
          .renderer = services.workers.info()};
}

} // namespace gnomon
