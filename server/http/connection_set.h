#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "server/http/client_address.h"
#include "server/system/clock.h"
#include "server/system/file_descriptor.h"

namespace gnomon {

/// A connection that no thread serves.
struct PendingConnection {
  OpenConnection connection;
  Clock::time_point since;
  Clock::time_point deadline;
  PeerAddress client{};   ///< that sent the complete head (client_address.h)
  bool isReady = false;   ///< its head is complete and has no thread yet
  bool isWaiting = false; ///< for a thread, since it is no probe
};

/// Those connections, registered with epoll. One thread at a time.
class ConnectionSet {
 public:
  /// `wake` interrupts wait(). Throws std::system_error.
  explicit ConnectionSet(StopSignal& wake);

  std::map<int, PendingConnection>& all() { return all_; } ///< by descriptor
  PendingConnection* find(int fd);                         ///< nullptr = it is gone

  /// nullptr where the system has no memory to watch the connection, which is closed then.
  PendingConnection* admit(OpenConnection connection);
  OpenConnection release(int fd); ///< one of them leaves with its connection open
  void drop(int fd) { all_.erase(fd); }

  void stopReading(const PendingConnection& pending);   ///< what it sends stays in its socket
  void resumeReading(const PendingConnection& pending); ///< again

  void setDeadline(PendingConnection& pending, std::chrono::milliseconds patience); ///< its deadline, from now
  void shortenDeadline(PendingConnection& pending,
                       std::chrono::milliseconds patience); ///< the same, if that is earlier

  /// Drops what is past its deadline without a request, and returns what has begun one. Those that are ready are left.
  std::vector<PendingConnection*> takeExpired();

  /// Of the client that has the most connections, the one that has waited longest; nothing where every head is
  /// complete.
  std::optional<int> evictionCandidate() const;

  /// Of the client that has the most complete heads, the newest; nothing where there are none.
  std::optional<int> newestReady() const;

  struct Readable {
    int fd = -1;
    bool isLost = false; ///< nothing can be sent to it any more
  };

  /// Sleeps until bytes arrive, a deadline passes, `until`, or the wake.
  std::vector<Readable> wait(Clock::time_point until);

 private:
  /// Among those that are ready, or those that are not, and of the client with most of them: the first by `isBefore`.
  std::optional<int> firstOfBusiestClient(
      bool ready, const std::function<bool(Clock::time_point, Clock::time_point)>& isBefore) const;

  StopSignal& wake_;
  FileDescriptor poll_;
  std::map<int, PendingConnection> all_;
  Clock::time_point nextDeadline_ = Clock::time_point::max(); ///< no connection's is earlier
};

} // namespace gnomon
