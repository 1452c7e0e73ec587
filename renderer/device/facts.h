#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "protocol/report/frame_report.h"

/// What a device says of a frame when it is done: plain values, whoever drew it.
namespace gnomon {

/// How long something took, by the processor's clock and, where it has one, by the device's. Milliseconds.
struct WorkTime {
  double cpuMilliseconds = 0;
  std::optional<double> gpuMilliseconds{};
};

/// What went into one tile of the plan.
struct TileFacts {
  std::uint64_t casterTriangles = 0;
  std::uint64_t culledTriangles = 0;
  std::size_t drawCalls = 0;
  bool reused = false;            ///< an earlier frame's tile serves; at most texels that none has read were added
  std::optional<WorkTime> time{}; ///< absent where nothing was drawn
};

/// What finding one light's visibility layer took, at one number of samples a pixel.
struct LayerFacts {
  int light = 0; ///< index into the effective lights
  double cpuMilliseconds = 0;
  std::optional<std::uint64_t> tracedPixels{}; ///< that rays decided; absent where none were asked
};

struct FrameFacts {
  std::vector<TileFacts> tiles; ///< one a tile of the plan
  std::vector<LayerFacts> layers;
  std::vector<PassReport> passes; ///< in the order in which they ran
  std::uint64_t surveyedTriangles = 0;
  std::uint64_t shadedTriangles = 0;
  std::size_t otherDrawCalls = 0; ///< of what is no pass of its own
  MemoryReport memory;
  std::vector<StageTime> stages;
};

} // namespace gnomon
