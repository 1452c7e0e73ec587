#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <mutex>
#include <optional>
#include <utility>

#include "protocol/base/result.h"

namespace gnomon {

/// Asked while a long task runs; false ends it. By one thread at a time, but not always by the same one. Empty = nobody
/// listens.
using GoOn = std::function<bool()>;

/// Thrown out of a task that is to end, so that nothing half made is kept; `untilStopped` catches it. No
/// std::exception: what catches those lets it pass.
struct Stopped {};

/// Whether somebody still wants what a task makes. Any thread.
class Stop {
 public:
  explicit Stop(const GoOn& goOn) : goOn_(goOn) {}
  Stop(const Stop&) = delete;
  Stop& operator=(const Stop&) = delete;

  /// Cheap enough for every tile: reads a clock, and asks only every few milliseconds. Once true, always true.
  bool asked();

  /// What this thread's task listens to; nullptr = nothing.
  static Stop* current();

 private:
  using Clock = std::chrono::steady_clock;

  const GoOn& goOn_;
  std::mutex asking_;
  std::atomic<Clock::rep> next_{0}; ///< when to ask again
  std::atomic<bool> stopped_{false};
};

/// While this lives, the thread's task listens to `stop`; nullptr = to nothing.
class Listening {
 public:
  explicit Listening(Stop* stop);
  ~Listening();
  Listening(const Listening&) = delete;
  Listening& operator=(const Listening&) = delete;

 private:
  Stop* before_;
};

/// Throws Stopped where the thread's task is to end. The loops of parallel.h do this before each of their pieces, which
/// listen to what the thread that started them listens to; long work between them does it itself.
void stopIfAsked();

/// Locks, and meanwhile listens: another task may hold the mutex for long.
std::unique_lock<std::timed_mutex> lockUnlessStopped(std::timed_mutex& mutex);

/// The problem of what was stopped: of code unavailable.
Problem stoppedProblem();

/// What `task` returns, a Result or a Status, or `stoppedProblem` as soon as `goOn` says false. Where `goOn` is empty
/// the task listens to what this thread listens to already.
template <class Task>
auto untilStopped(const GoOn& goOn, Task&& task) -> decltype(task()) {
  std::optional<Stop> own;
  if (goOn) own.emplace(goOn);
  const Listening listening(own ? &*own : Stop::current());
  try {
    return std::forward<Task>(task)();
  } catch (const Stopped&) {
    return stoppedProblem();
  }
}

} // namespace gnomon
