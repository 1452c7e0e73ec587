#pragma once

#include <map>
#include <string>

#include "tests/bench/cost_series.h"

namespace gnomon::bench {

/// Medians of one point, milliseconds.
struct Cost {
  double floor = 0;                     ///< the bare depth-only draw of what is in view
  double whole = 0;                     ///< a warm request, from the decoded spec to pixels, not encoded
  std::map<std::string, double> stages; ///< of the report
  std::string problem;                  ///< why there is no figure; empty = measured
};

/// Draws floors and frames in turn, so that noise meets all alike, after a first of each that is not counted. Every
/// frame turns the lights by a little, so that none of its shadows can be one that was kept. One cost for each point.
std::vector<Cost> measure(Renderer& renderer, const CostSeries& series, int rounds);

} // namespace gnomon::bench
