#pragma once

#include <string>
#include <string_view>

#include "protocol/evaluation/evaluation.h"

namespace gnomon {

/// What the rows' `milliseconds` are, where a chart shows them as something else.
struct ChartTime {
  std::string axis = "milliseconds, whole warm frame, tiles drawn again";
  std::string unit = " ms"; ///< written behind each number
};

/// Speed against error as an SVG file: the error that rows are ranked by (logarithmic; 0 on a floor of its own) over
/// milliseconds (logarithmic). Rows on the Pareto front are joined by steps; each point's number leads to its name
/// beside the chart. Rows without figures follow the others, with the reason.
std::string evaluationChart(const EvaluationReport& report, const ChartTime& time = {});

/// A report's rows as CSV (RFC 4180) with a line of names: name, problem, milliseconds, a column for each stage that
/// any row has ("shade ms"), memoryBytes, every metric ("edgeDisplacement.p95"), pareto. What a row lacks is empty.
std::string evaluationCsv(const EvaluationReport& report);

/// A value as a field: in quotes where it holds a comma, a quote or a line break.
std::string csvField(std::string_view text);

} // namespace gnomon
