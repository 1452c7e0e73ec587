#pragma once

#include <string>
#include <vector>

#include "protocol/evaluation/evaluation.h"
#include "protocol/report/replies.h"

namespace gnomon::cli {

/// A report for people: a line for each row, times also as multiples of the first that has one, `*` on the Pareto
/// front, and below what it was held against.
std::string evaluationTable(const EvaluationReport& report);

/// What a frame's shadows get wrong, in one line: "wrong 0.4200 % (false shadow 0.3000 %, false lit 0.1200 %), edges
/// 0.31 pixels off".
std::string errorText(const ErrorMetrics& metrics);

/// The warnings of a frame's or a sequence's report.
std::vector<std::string> warningsOf(const std::string& reportJson);

/// The summary as a tree of lines for people. `title` is its root.
std::string summaryText(const std::string& title, const SceneSummary& summary);

} // namespace gnomon::cli
