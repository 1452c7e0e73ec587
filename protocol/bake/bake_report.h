#pragma once

#include <string>
#include <vector>

#include "protocol/report/frame_report.h"

/// Rows of the fields: bake_rows.h.
namespace gnomon {

/// One light's shadow, baked.
struct BakedLightReport {
  int light = 0;
  LightMapReport lightMap{};
};

/// What baking ahead made.
struct BakeReport {
  std::string key{};
  std::vector<BakedLightReport> lights{};
  double milliseconds = 0;
};

/// How far a bake has come.
struct BakeStep {
  std::string key{};
  int light = 0;
  double share = 0;
  int done = 0;
  int of = 0;
};

} // namespace gnomon
