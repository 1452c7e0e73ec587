#pragma once

#include <string>

#include "protocol/evaluation/evaluation.h"

namespace gnomon {

/// What the rows' `milliseconds` are, where a chart shows them as something else.
struct ChartTime {
  std::string axis = "milliseconds, whole warm frame, tiles drawn again";
  std::string unit = " ms"; ///< written behind each number
};

/// Speed against error as an SVG file: misclassified share (logarithmic; 0 on a floor of its own) over milliseconds
/// (logarithmic). Rows on the Pareto front are joined by steps; each point's number leads to its name beside the chart.
/// Rows without figures follow the others, with the reason.
std::string evaluationChart(const EvaluationReport& report, const ChartTime& time = {});

} // namespace gnomon
