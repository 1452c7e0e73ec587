#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tests/bench/bench_scenes.h"

namespace gnomon::bench {

/// What is measured.
struct DeviceRun {
  std::filesystem::path program;    ///< gnomon
  std::vector<std::string> devices; ///< those that are there, of cpu and gl
  int rounds = 11;                  ///< that count; colder things take a third of them
};

/// A way to ask for a frame.
struct Setting {
  std::string name;
  nlohmann::json patch; ///< of the spec
  int samples = 1;      ///< of a pixel
};

/// Exact shadows, maps, and the defaults, as patches of a spec that holds camera, sun and size.
const std::vector<Setting>& settings();

/// Medians in milliseconds, or MiB; one for each device of the run, in its order.
struct CostRow {
  std::string scene;
  std::string setting;
  std::string unit;
  std::vector<double> devices;
  std::vector<double> processor; ///< time of all threads for the same frames; empty = not measured
  std::optional<double> floor;   ///< the bare depth-only draw through OpenGL, where there is one and it is meant
};

/// Warm frames in every setting (with the floor as one more turn), a cold one from the command line, and the server's
/// peak memory after all of these.
std::vector<CostRow> costsOf(const DeviceRun& run, const BenchScene& scene);

} // namespace gnomon::bench
