#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>

#include "protocol/base/result.h"
#include "server/http/socket_io.h"

namespace gnomon {

/// Work for the queue's thread. Exactly one of `run` and `drop` is called, on that thread (or, at the end, on the one
/// that ends the queue). Neither throws.
struct Job {
  Clock::time_point deadline;
  std::function<bool()> wanted;             ///< false = nobody waits for it any more; asked just before it would run
  std::function<void(double waitedMs)> run; ///< told how long it stood in the queue
  std::function<void(const Problem&)> drop; ///< it will never run: deadlineExceeded or unavailable
};

/// A full queue: come again later.
struct QueueFull {
  std::size_t limit = 0;
  int retryAfterSeconds = 1;
};

/// Seconds until a queue of this length has a place, from what jobs took lately: 1..60.
int retryAfterSeconds(double jobMilliseconds, std::size_t waiting);

/// A bounded queue in front of one thread, first in first out.
class JobQueue {
 public:
  /// `limit` jobs may wait; the one that runs is not counted. `atEnd` is the last that the thread does.
  explicit JobQueue(std::size_t limit, std::function<void()> atEnd = {});
  ~JobQueue() { close(Clock::now()); }
  JobQueue(const JobQueue&) = delete;
  JobQueue& operator=(const JobQueue&) = delete;

  std::optional<QueueFull> submit(Job job); ///< nothing = accepted

  /// Takes no more jobs, runs those that wait until `deadline`, drops the rest, and ends the thread.
  void close(Clock::time_point deadline);

  std::size_t waiting() const;
  std::size_t limit() const { return limit_; }

 private:
  struct Entry {
    Job job;
    Clock::time_point since;
  };
  void work();
  void finish(Entry entry);

  const std::size_t limit_;
  const std::function<void()> atEnd_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Entry> entries_;
  double jobMs_ = 0; ///< moving average of what a job takes
  std::optional<Clock::time_point> closing_;
  std::thread thread_;
};

} // namespace gnomon
