#pragma once

#include <string>
#include <vector>

#include "protocol/report/frame_report.h"

namespace gnomon {

/// One light's shadow, baked.
struct BakedLightReport {
  int light = 0; ///< index into the lights of the spec, or of the scene where that has none
  LightMapReport lightMap{};
};

/// What baking ahead made.
struct BakeReport {
  std::string key{};                      ///< of the scene and of what the bake depends on: 64 hexadecimal digits
  std::vector<BakedLightReport> lights{}; ///< those of technique lightMap
  double milliseconds = 0;                ///< of all of it, what was found ready included
};

/// How far a bake has come.
struct BakeStep {
  std::string key{};
  int light = 0;    ///< index of the light that is baked
  double share = 0; ///< of its texels that are done, 0..1
  int done = 0;     ///< lights that are finished
  int of = 0;       ///< of all that are to be baked
};

} // namespace gnomon
