#pragma once

#include <memory>
#include <string>

#include "server/http/connection.h"

namespace gnomon {

struct HttpServerOptions {
  std::string bind = "127.0.0.1";
  int port = 0;              ///< 0 = any free one
  std::size_t threads = 128; ///< connections served at once; further ones get probes answered and else 503
};

/// Listens, accepts, and hands connections to threads.
class HttpServer {
 public:
  /// Listening once it returns; nothing is accepted before run(). `context` outlives the server.
  static Result<std::unique_ptr<HttpServer>> listen(const HttpServerOptions& options, ConnectionContext& context);
  ~HttpServer();

  int port() const;

  /// Serves until stop(), and returns when every accepted request is answered. False: accepting failed.
  bool run();

  /// No further connection is accepted and no further request read. Any thread, any time.
  void stop();

 private:
  struct Impl;
  explicit HttpServer(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

} // namespace gnomon
