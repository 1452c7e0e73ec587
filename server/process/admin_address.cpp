#include "server/process/admin_address.h"

#include <algorithm>
#include <utility>

#include "server/http/origin_check.h"
#include "server/system/log.h"

namespace gnomon {
namespace {

constexpr std::size_t kReplyBytes = 8 << 20;

ConnectionLimits connectionLimits() {
  ConnectionLimits limits;
  limits.maxWaiting = kAdminWaiting;
  return limits;
}

} // namespace

AdminAddress::AdminAddress(const AdminAddressOptions& options, Services& services, RequestObserver& observer)
    : replyBytes_(kReplyBytes),
      context_{withOriginCheck(makeService(makeAdminRoutes(services)), {options.allowedHosts, {}, options.bind}),
               connectionLimits(),
               ByteBudget(0),
               replyBytes_,
               {},
               {},
               {},
               {},
               &observer} {}

Result<std::unique_ptr<AdminAddress>> AdminAddress::open(const AdminAddressOptions& options, Services& services,
                                                         RequestObserver& observer) {
  std::unique_ptr<AdminAddress> admin(new AdminAddress(options, services, observer));
  auto server = HttpServer::listen({options.bind, options.port, kAdminThreads, kAdminThreads}, admin->context_);
  if (!server) return std::move(server).problems();
  admin->server_ = *std::move(server);
  admin->serving_ = std::thread([&server = *admin->server_] { server.run(); });
  logEvent("admin", addressOf(options.bind, admin->server_->port()));
  return admin;
}

AdminAddress::~AdminAddress() {
  if (!serving_.joinable()) return;
  server_->stop();
  serving_.join();
}

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
