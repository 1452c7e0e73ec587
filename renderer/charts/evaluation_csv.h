#pragma once

#include <string>
#include <string_view>

#include "protocol/evaluation/evaluation.h"

namespace gnomon {

/// A report's rows as CSV (RFC 4180) with a line of names: name, problem, milliseconds, a column for each stage that
/// any row has ("shade ms"), memoryBytes, every metric ("edgeDisplacement.p95"), pareto. What a row lacks is empty.
std::string evaluationCsv(const EvaluationReport& report);

/// A value as a field: in quotes where it holds a comma, a quote or a line break.
std::string csvField(std::string_view text);

} // namespace gnomon
