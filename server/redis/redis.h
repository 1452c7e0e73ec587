#pragma once

#include <algorithm>
#include <chrono>
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

  /// A connection for the caller alone, as for what it subscribes to.
  Result<std::unique_ptr<Connection>> connect(const Call& call);

  Clock::time_point nextAttempt() const; ///< before it, no call connects; a time that has passed = now
  Use use() const;
  const Address& address() const { return options_.address; }

 private:
  class Place;

  Problem lost(const Problem& reason, bool isProbe);
  void reached();
  Problem away() const;

  const Options options_;
  mutable std::mutex mutex_;
  std::condition_variable placeFree_;
  std::size_t taken_ = 0; ///< connections in calls
  std::vector<std::unique_ptr<Connection>> idle_;
  int failuresInARow_ = 0;
  Clock::time_point nextAttempt_ = Clock::time_point::min();
  std::minstd_rand random_;
  Use counted_;
};

/// How long to leave a server alone after so many failures in a row, >= 1: from 50 ms on twice as long each time, up
/// to 5 s, and of that between half and all, so that many clients do not come at once. `random`: 0..1.
inline std::chrono::milliseconds backoffDelay(int failures, double random) {
  constexpr std::chrono::milliseconds kFirst{50};
  constexpr std::chrono::milliseconds kLongest{5'000};
  constexpr int kDoublings = 7; // more would pass the longest
  const auto whole = std::min(kFirst * (1 << std::clamp(failures - 1, 0, kDoublings)), kLongest);
  return std::chrono::milliseconds(static_cast<std::int64_t>(static_cast<double>(whole.count()) * (0.5 + random / 2)));
}

} // namespace gnomon::redis
