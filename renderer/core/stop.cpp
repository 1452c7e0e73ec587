#include "renderer/core/stop.h"

namespace gnomon {
namespace {

thread_local Stop* currentStop = nullptr;

} // namespace

bool Stop::asked() {
  constexpr Clock::duration kPause = std::chrono::milliseconds(2);
  if (stopped_.load(std::memory_order_relaxed)) return true;
  if (Clock::now().time_since_epoch().count() < next_.load(std::memory_order_relaxed)) return false;
  const std::unique_lock lock(asking_, std::try_to_lock);
  if (!lock) return false;
  if (!stopped_.load(std::memory_order_relaxed) && !goOn_()) stopped_.store(true, std::memory_order_relaxed);
  next_.store((Clock::now() + kPause).time_since_epoch().count(), std::memory_order_relaxed);
  return stopped_.load(std::memory_order_relaxed);
}

Stop* Stop::current() {
  return currentStop;
}

CancellationScope::CancellationScope(Stop* stop) : before_(std::exchange(currentStop, stop)) {}

CancellationScope::~CancellationScope() {
  currentStop = before_;
}

void stopIfAsked() {
  if (currentStop != nullptr && currentStop->asked()) throw Stopped{};
}

std::unique_lock<std::timed_mutex> lockUnlessStopped(std::timed_mutex& mutex) {
  constexpr std::chrono::milliseconds kAskAgain{5};
  std::unique_lock lock(mutex, std::try_to_lock);
  while (!lock && !lock.try_lock_for(kAskAgain)) stopIfAsked();
  return lock;
}

Problem stoppedProblem() {
  return {ProblemCode::unavailable, "", "Cancelled: the client no longer waits for it."};
}

} // namespace gnomon
