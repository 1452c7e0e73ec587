#pragma once

#include <chrono>
#include <cstddef>
#include <vector>

#include "protocol/cost/frame_cost.h"

namespace gnomon {

/// Frames that were not done by their deadlines, though they were at work until then: lower bounds of the time that
/// such frames take, where no estimate is needed. The first deadline proves little, since what a frame leaves finished
/// spares the next one work; the second of frames that cost the same is taken as a bound, for some minutes. For one
/// thread at a time.
class PassedDeadlines {
 public:
  using Clock = std::chrono::steady_clock;

  /// A frame of this cost was at work for so long and not done.
  void passed(const FrameCost& cost, double milliseconds, Clock::time_point now);

  /// A frame of this cost was done in so long: bounds of frames that are no more work, and took longer, are wrong.
  void done(const FrameCost& cost, double milliseconds);

  /// Milliseconds that a frame of this cost takes at least: the largest bound of frames that are no more work in any
  /// part. 0 = none is known.
  double atLeast(const FrameCost& cost, Clock::time_point now) const;

 private:
  struct Bound {
    FrameCost cost;
    double milliseconds = 0;
    int times = 0;
    Clock::time_point last;
  };

  std::vector<Bound> bounds_; ///< the oldest first
};

} // namespace gnomon
