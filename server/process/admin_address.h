#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "server/handlers/handlers.h"
#include "server/http/connection.h"
#include "server/http/http_server.h"
#include "server/metrics/readings.h"
#include "server/process/serve.h"

namespace gnomon {

inline constexpr std::size_t kAdminThreads = 4;  ///< requests that are served at once
inline constexpr std::size_t kAdminWaiting = 32; ///< connections that have no request to serve

struct AdminAddressOptions {
  std::string bind;
  int port = 0;                          ///< 0 = any free one
  std::vector<std::string> allowedHosts; ///< as in OriginRules
};

/// The second address of a server, where operators look: metrics and probes, without keys. It has threads of its own,
/// so that it answers while all others are taken.
class AdminAddress {
 public:
  /// Serves once it returns, until it is destroyed; the log says where. `services` and `observer` outlive it.
  static Result<std::unique_ptr<AdminAddress>> open(const AdminAddressOptions& options, Services& services,
                                                    RequestObserver& observer);
  ~AdminAddress();

 private:
  AdminAddress(const AdminAddressOptions& options, Services& services, RequestObserver& observer);

  ByteBudget replyBytes_;
  ConnectionContext context_;
  std::unique_ptr<HttpServer> server_;
  std::thread serving_;
};

/// What the server is like now. Reads the store's directory, if there is one.
metrics::Snapshot snapshotOf(const ServeOptions& options, Services& services, const ConnectionContext& context);

} // namespace gnomon
