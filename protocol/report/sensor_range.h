#pragma once

namespace gnomon {

/// What a depth sensor can measure, metres.
struct SensorRange {
  double min = 0; ///< what is nearer is too close
  double max = 0; ///< what is farther is too far
};

} // namespace gnomon
