#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>

#include "protocol/base/result.h"
#include "server/system/clock.h"

namespace gnomon {

/// Work for the queue's thread. Of an accepted job exactly one of `run` and `drop` is called, once, on the queue's
/// thread; only where the queue is closed already, submit() calls `drop` itself, on the caller's. Neither throws.
struct Job {
  Clock::time_point deadline;
  std::function<bool()> wanted;             ///< false = its caller has left; called just before the job would run
  std::function<void(double waitedMs)> run; ///< given the time that the job waited in the queue
  std::function<void(const Problem&)> drop; ///< the job will never run: deadlineExceeded or unavailable
};

/// Why a job was not accepted; neither `run` nor `drop` is called.
struct QueueFull {
  std::size_t limit = 0;     ///< jobs that may wait
  int retryAfterSeconds = 1; ///< when there may be room again

  Problem problem() const;
};

/// Seconds until a queue of this length has a place, from what jobs took lately: 1..60.
int retryAfterSeconds(double jobMilliseconds, std::size_t waiting);

/// A bounded queue in front of one thread, first in first out.
class JobQueue {
 public:
  /// `limit` jobs may wait; the running one is not counted. `atEnd` is the last call on the queue's thread.
  explicit JobQueue(std::size_t limit, std::function<void()> atEnd = {});
  ~JobQueue() { close(Clock::now()); }
  JobQueue(const JobQueue&) = delete;
  JobQueue& operator=(const JobQueue&) = delete;

  /// Nothing where the job was accepted, or dropped because the queue is closed.
  std::optional<QueueFull> submit(Job job);

  /// Accepts no more jobs, runs the waiting ones until `deadline`, drops the rest, and ends the thread.
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
