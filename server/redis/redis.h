#pragma once

#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <random>
#include <string>
#include <vector>

#include "protocol/base/result.h"
#include "server/redis/address.h"
#include "server/redis/connection.h"
#include "server/redis/reply.h"

/// A client of Redis 7, by the protocol RESP2.
namespace gnomon::redis {

struct Options {
  Address address;
  std::size_t connections = 8;                      ///< >= 1; for calls at the same time; others wait for one
  std::size_t blockingConnections = 8;              ///< >= 1; the same, for calls of block()
  std::chrono::milliseconds connectPatience{2'000}; ///< for one attempt to connect, where the call has so much time
};

/// Connection statistics.
struct Use {
  bool isReachable = true;     ///< the last attempt to connect or to call went well, or there was none
  std::size_t connections = 0; ///< open now
  std::uint64_t calls = 0;     ///< since the start
  std::uint64_t failures = 0;  ///< of those: without replies
  std::uint64_t connected = 0; ///< connections made since the start
};

/// Calls to one Redis server over connections that are kept. Any thread.
///
/// A call either has a reply to each of its commands, which may be errors of the server, or it has a problem:
/// unavailable, where the server is away or does not answer by the call's deadline. It is unknown then whether the
/// commands were carried out; none is sent twice. While a server is away, most calls fail at once: it is tried again at
/// growing intervals (backoffDelay), by the call that comes then. The log says when it goes and comes.
class Redis {
 public:
  explicit Redis(Options options);

  Result<Reply> ask(const Command& command, const Call& call);

  /// Sends all at once. Other clients' commands may come between them.
  Result<std::vector<Reply>> pipeline(const std::vector<Command>& commands, const Call& call);

  /// Runs a script.
  Result<Reply> run(const Script& script, const std::vector<std::string>& keys,
                    const std::vector<std::string>& arguments, const Call& call);

  /// A command that waits in the server, as XREADGROUP with BLOCK. It has to end before the call's deadline by itself.
  /// Takes no connection from other calls.
  Result<Reply> block(const Command& command, const Call& call);

  /// A connection for the caller alone, as for what it subscribes to.
  Result<std::unique_ptr<Connection>> connect(const Call& call);

  Clock::time_point nextAttempt() const; ///< before it, no call connects; a time that has passed = now
  Use use() const;
  const Address& address() const { return options_.address; }

 private:
  /// Connections of one purpose.
  struct Pool {
    const std::size_t most;
    std::size_t taken = 0;
    std::vector<std::unique_ptr<Connection>> idle{};
  };
  class Place;

  Result<std::vector<Reply>> call(Pool& pool, const std::vector<Command>& commands, const Call& call);
  Problem lost(const Problem& reason, bool isProbe);
  void reached();
  Problem away() const;

  const Options options_;
  mutable std::mutex mutex_;
  std::condition_variable placeFree_;
  Pool pool_;
  Pool blocking_;
  int failuresInARow_ = 0;
  Clock::time_point nextAttempt_ = Clock::time_point::min();
  std::minstd_rand random_;
  Use counted_;
};

} // namespace gnomon::redis
