#pragma once

#include <chrono>
#include <cstddef>
#include <deque>
#include <optional>
#include <string>

#include "protocol/base/lru.h"
#include "server/dispatch/task.h"

namespace gnomon {

/// What ends workers: requests that ended two are not tried a third time for a while, from any client, and a client
/// whose requests end several has none tried for the rest of a minute. Of each the last kMost are known. For one thread
/// at a time.
class StrikeList {
 public:
  static constexpr std::chrono::seconds kRequestRest{300}; ///< that a request which ended two workers is not tried
  static constexpr std::chrono::seconds kClientWindow{60}; ///< in which a client's ends are counted
  static constexpr std::size_t kClientEnds = 4;            ///< workers that a client's requests may end in that time
  static constexpr std::size_t kMost = 1024;

  /// The task's request ended two workers; `problem` is what its caller was sent.
  void addRequest(const Task& task, Problem problem, Clock::time_point now);

  /// A task of the client ended a worker.
  void addEnd(const std::string& client, Clock::time_point now);

  struct Refusal {
    Problem problem; ///< that of the request, with when it may be tried again; busy where it is the client's
    int retryAfterSeconds = 1;
    bool isOfClient = false;
  };

  /// Why no worker is given the task now; nothing = it may be tried.
  std::optional<Refusal> refusalOf(const Task& task, Clock::time_point now);

  /// The same, by the client alone.
  std::optional<Refusal> refusalOf(const std::string& client, Clock::time_point now);

 private:
  struct Request {
    std::string key;
    Problem problem;
    Clock::time_point until;
  };
  struct Client {
    std::string name;
    std::deque<Clock::time_point> ends; ///< the last kClientEnds
  };
  LruList<Request> requests_;
  LruList<Client> clients_;
};

} // namespace gnomon
