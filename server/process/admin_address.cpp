#include "server/process/admin_address.h"

#include <utility>

#include "server/handlers/routes.h"
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

} // namespace gnomon
