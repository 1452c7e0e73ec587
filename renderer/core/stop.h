#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <mutex>
#include <optional>
#include <utility>

#include "protocol/base/result.h"

namespace gnomon {

/// Called with the progress of a long task, 0..1, by one thread at a time; false cancels it. Empty = not reported.
using Progress = std::function<bool(double)>;

/// Called while a long task runs; false cancels it. By one thread at a time, not always the same one. Empty = never
/// cancelled.
using GoOn = std::function<bool()>;

/// Thrown by a cancelled task, so that no partial result is kept; `untilStopped` catches it. Not a std::exception, so
/// that handlers of those let it pass.
struct Stopped {};

/// Cancellation state of a task. Any thread.
class Stop {
 public:
  explicit Stop(const GoOn& goOn) : goOn_(goOn) {}
  Stop(const Stop&) = delete;
  Stop& operator=(const Stop&) = delete;

  /// Cheap enough for every tile: reads a clock, and calls GoOn only every few milliseconds. Once true, always true.
  bool asked();

  /// That of this thread's task; nullptr = it can't be cancelled.
  static Stop* current();

 private:
  using Clock = std::chrono::steady_clock;

  const GoOn& goOn_;
  std::mutex asking_;
  std::atomic<Clock::rep> next_{0}; ///< time of the next call of GoOn
  std::atomic<bool> stopped_{false};
};

/// Scope in which `stop` is the state of this thread's task; nullptr = none.
class CancellationScope {
 public:
  explicit CancellationScope(Stop* stop);
  ~CancellationScope();
  CancellationScope(const CancellationScope&) = delete;
  CancellationScope& operator=(const CancellationScope&) = delete;

 private:
  Stop* before_;
};

/// Throws Stopped if this thread's task is cancelled. The loops of parallel.h call it before each piece, in the scope
/// of the thread that started them; long work between them calls it itself.
void stopIfAsked();

/// Locks, and throws Stopped if cancelled meanwhile: another task may hold the mutex for long.
std::unique_lock<std::timed_mutex> lockUnlessStopped(std::timed_mutex& mutex);

/// The problem of a cancelled task, of code unavailable.
Problem stoppedProblem();

/// What `task` returns, a Result or a Status, or `stoppedProblem` as soon as `goOn` returns false. With an empty `goOn`
/// the task keeps this thread's state.
template <class Task>
auto untilStopped(const GoOn& goOn, Task&& task) -> decltype(task()) {
  std::optional<Stop> own;
  if (goOn) own.emplace(goOn);
  const CancellationScope scope(own ? &*own : Stop::current());
  try {
    return std::forward<Task>(task)();
  } catch (const Stopped&) {
    return stoppedProblem();
  }
}

} // namespace gnomon
