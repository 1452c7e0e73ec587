#pragma once

#include <atomic>
#include <chrono>

#include "server/system/clock.h"

namespace gnomon {

/// How long a state has lasted. Any thread.
class Lasting {
 public:
  void begin() {
    Clock::rep none = 0;
    since_.compare_exchange_strong(none, Clock::now().time_since_epoch().count());
  }
  void end() { since_ = 0; }

  /// 0 = it is over.
  Clock::duration duration() const {
    const Clock::rep since = since_;
    return since == 0 ? Clock::duration() : Clock::now().time_since_epoch() - Clock::duration(since);
  }

 private:
  std::atomic<Clock::rep> since_ = 0;
};

} // namespace gnomon
