#pragma once

#include <functional>
#include <optional>
#include <string>

#include "server/http/open_connection.h"

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

} // namespace gnomon
