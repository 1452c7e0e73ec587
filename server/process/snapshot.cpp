#include "server/process/snapshot.h"

#include "server/system/log.h"

namespace gnomon {

metrics::Snapshot snapshotOf(const ServeOptions& options, Services& services, const ConnectionContext& context) {
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
          .logLinesDropped = logLinesDropped(),
          .draining = services.draining,
          .process = metrics::processUse(),
          .version = GNOMON_VERSION,
          .renderer = services.workers.info()};
}

} // namespace gnomon
