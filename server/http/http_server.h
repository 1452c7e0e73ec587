#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "server/http/client_address.h"
#include "server/http/connection.h"
#include "server/http/pending_connections.h"

namespace gnomon {

/// What an accept loop does after accept() has failed.
enum class AfterAccept {
  next,  ///< that one connection failed
  pause, ///< the system is out of descriptors or memory for a moment
  giveUp ///< the socket can accept nothing any more
};
AfterAccept afterAccept(int error);

/// A socket that listens, and its accept loop.
class Listener {
 public:
  /// Nothing where the address can't be listened on. `port` 0 = any free one.
  static std::optional<Listener> open(const std::string& bind, int port);

  int port() const;

  /// Accepts connections until `stop` is raised; then listens no longer. `scarce` is called where the system has no
  /// descriptor or memory left; accepting goes on a moment later. False: it can't go on at all.
  bool run(const StopSignal& stop, const std::function<void(OpenConnection)>& accepted,
           const std::function<void()>& scarce);

 private:
  explicit Listener(FileDescriptor socket) : socket_(std::move(socket)) {}

  FileDescriptor socket_;
};

struct HttpServerOptions {
  std::string bind = "127.0.0.1";
  int port = 0;              ///< 0 = any free one
  std::size_t threads = 128; ///< requests served at once; beyond them only probes are answered, all else gets 503
  std::size_t perClient = 0; ///< of these for one client; beyond them it gets 429. 0 = its share (fair_shares.h)
};

/// "http://127.0.0.1:8080".
std::string addressOf(const std::string& bind, int port);

/// Listens, accepts, and hands over connections.
class HttpServer {
 public:
  /// Listening once it returns; nothing is accepted before run(). `context` outlives the server.
  static Result<std::unique_ptr<HttpServer>> listen(const HttpServerOptions& options, ConnectionContext& context);

  int port() const { return listener_.port(); }

  /// Serves until stop(), and returns when every request whose head has begun to come is answered. False: accepting
  /// failed.
  bool run();

  /// No further connection is accepted and no further request read. Any thread, any time.
  void stop() { context_.stop.raise(); }

  /// After stop(): requests that have not come whole are waited for no longer, and get 503.
  void cutBodies() {
    context_.cutBodies.raise();
    pending_.cutOff();
  }

  /// After cutBodies(): neither are clients that are taking their replies.
  void cutReplies() { context_.cutReplies.raise(); }

 private:
  HttpServer(Listener listener, ConnectionContext& context, const HttpServerOptions& options)
      : context_(context), listener_(std::move(listener)), pending_(context, options.threads, options.perClient) {}

  ConnectionContext& context_;
  Listener listener_;
  PendingConnections pending_;
};

} // namespace gnomon
