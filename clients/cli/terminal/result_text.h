#pragma once

#include <string>

#include "protocol/evaluation/evaluation.h"
#include "protocol/report/replies.h"

namespace gnomon::cli {

/// A report for people: a line for each row, times also as multiples of the first that has one, `*` on the Pareto
/// front, and below what it was held against.
std::string evaluationTable(const EvaluationReport& report);

/// The summary as a tree of lines for people. `title` is its root.
std::string summaryText(const std::string& title, const SceneSummary& summary);

} // namespace gnomon::cli
