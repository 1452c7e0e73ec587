#pragma once

#include <chrono>
#include <optional>

#include "renderer/gl/object.h"

namespace gnomon::gl {

/// How long a run of work takes, by the processor's clock and by the device's. A default-made one measured nothing.
/// Device times are GL_TIMESTAMP queries: what the driver says, with the work of others that it did in between. A
/// software driver has no other clock than the processor's, and one that draws in tiles meets both marks in each of its
/// tiles: there, a run that does not begin in an earlier submission than its draws shows the time of the last tile
/// alone.
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
  struct Delete {
    void operator()(GLuint id) const { glDeleteQueries(1, &id); }
  };
  using Clock = std::chrono::steady_clock;
  using Query = Object<Delete{}>;

  static Query mark();

  Clock::time_point cpuBegin_;
  Clock::time_point cpuEnd_;
  Query gpuBegin_; ///< none where the driver has no timer
  Query gpuEnd_;
  bool stopped_ = false;
};

} // namespace gnomon::gl
