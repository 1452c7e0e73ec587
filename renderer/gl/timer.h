#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "protocol/report/frame_report.h"
#include "renderer/gl/object.h"

namespace gnomon::gl {

struct DeleteQuery {
  void operator()(GLuint id) const { glDeleteQueries(1, &id); }
};

/// A point of the device's time: when all work that was handed to it before is done. Holds no query where it is
/// default-made or the driver has no timer. A software driver has no other clock than the processor's, and one that
/// draws in tiles passes the point in each of its tiles: the last one counts.
class Timestamp {
 public:
  Timestamp() = default;
  static Timestamp now();

  /// Nanoseconds by the device's own clock. Waits until the device has passed the point. Absent without a query.
  std::optional<GLuint64> nanoseconds() const;

 private:
  Object<DeleteQuery{}> query_;
};

/// How long a run of work takes, by the processor's clock and by the device's. A default-made one measured nothing.
/// Device times have the work of others in them that the driver did in between. On a driver that draws in tiles a run
/// that does not begin in an earlier submission than its draws shows the time of the last tile alone.
class Timer {
 public:
  Timer() = default;
  static Timer start();
  void stop();

  bool stopped() const { return stopped_; }
  double cpuMilliseconds() const;
  /// Waits until the device has passed the end. Absent where nothing was measured or the driver has no timer.
  std::optional<double> gpuMilliseconds() const;

 private:
  using Clock = std::chrono::steady_clock;

  Clock::time_point cpuBegin_;
  Clock::time_point cpuEnd_;
  Timestamp gpuBegin_;
  Timestamp gpuEnd_;
  bool stopped_ = false;
};

/// Wall time of stages that follow each other, measured without waiting for the device. A stage's time runs from the
/// end of the one before it to its own end, so that the times of all stages add up to the whole.
class StageClock {
 public:
  StageClock() : begin_(Clock::now()) {}

  /// Ends a stage that leaves the device nothing to do: it gave it nothing, or waited for it. The processor's clock
  /// counts, so what the device does all the same counts for the next stage.
  void finish(std::string stage);
  /// Ends a stage whose draws the device may still be at, and hands them over. It ends when the device is done with
  /// them, or where the driver has no timer, here; what the processor does meanwhile in the next stage is no part of
  /// that one's time.
  void finishDrawing(std::string stage);
  /// The stages so far, in the order in which they first ended; a name met again adds to its first entry. Waits for
  /// the device. The clock is then as if new.
  std::vector<StageTime> take();

 private:
  using Clock = std::chrono::steady_clock;
  struct End {
    std::string stage;
    Clock::time_point cpu;
    Timestamp gpu;
  };

  Clock::time_point begin_;
  std::vector<End> ends_;
};

} // namespace gnomon::gl
