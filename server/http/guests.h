#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "server/http/open_connection.h"
#include "server/system/clock.h"
#include "server/system/file_descriptor.h"

namespace gnomon {

/// A connection that no thread serves.
struct Guest {
  OpenConnection connection;
  Clock::time_point since;
  Clock::time_point deadline;
  PeerAddress client{};   ///< who sent the head that is complete (client_address.h)
  bool isReady = false;   ///< its head is complete and has no thread yet
  bool isWaiting = false; ///< for a thread, since it is no probe
};

/// Those connections, and what the system tells of them (epoll). One thread at a time.
class Guests {
 public:
  /// `wake` interrupts listen(). Throws std::system_error.
  explicit Guests(StopSignal& wake);

  std::map<int, Guest>& all() { return all_; } ///< by descriptor
  Guest* find(int fd);                         ///< nullptr = it is gone

  /// nullptr where the system has no memory to watch the connection, which is closed then.
  Guest* admit(OpenConnection connection);
  OpenConnection release(int fd); ///< one of them leaves with its connection open
  void drop(int fd) { all_.erase(fd); }

  void ignore(const Guest& guest); ///< what it sends stays in its socket
  void heed(const Guest& guest);   ///< again

  void expectBy(Guest& guest, std::chrono::milliseconds patience); ///< its deadline, from now
  void hurry(Guest& guest, std::chrono::milliseconds patience);    ///< the same, if that is earlier

  /// Drops whoever is late and has no request, and gives those that have begun one. Guests that are ready are left.
  std::vector<Guest*> takeLate();

  /// Of the client that has the most guests, the one that has waited longest; nothing where every head is complete.
  std::optional<int> leastWanted() const;

  /// Of the client that has the most complete heads, the newest; nothing where there are none.
  std::optional<int> lastToAsk() const;

  struct Heard {
    int fd = -1;
    bool isLost = false; ///< nothing can be sent to it any more
  };

  /// Sleeps until somebody sends something, someone is late, `until`, or the wake.
  std::vector<Heard> listen(Clock::time_point until);

 private:
  /// Among those that are ready, or those that are not, and of the client with most of them: who comes first.
  std::optional<int> ofWhoHasMost(bool ready,
                                  const std::function<bool(Clock::time_point, Clock::time_point)>& isBefore) const;

  StopSignal& wake_;
  FileDescriptor poll_;
  std::map<int, Guest> all_;
  Clock::time_point nextDeadline_ = Clock::time_point::max(); ///< no guest's is earlier
};

} // namespace gnomon
