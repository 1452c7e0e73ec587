#pragma once

#include "tests/bench/device_costs.h"

namespace gnomon::bench {

/// One figure that is not a scene's: a time, or how many times as much one thing takes as another.
struct DeviceFact {
  std::string what;
  std::vector<std::optional<double>> devices; ///< in the run's order; empty = it does not apply
  int digits = 2;                             ///< after the point
};

struct FactScenes {
  BenchScene demo, city;
  BenchScene busy; ///< for cores and instruction sets: many triangles
};

/// Starts, small frames, and what more triangles, lights, cores, wider instructions and clients do.
std::vector<DeviceFact> factsOf(const DeviceRun& run, const FactScenes& scenes);

} // namespace gnomon::bench
