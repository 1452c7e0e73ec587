#pragma once

#include <string>

#include "protocol/evaluation/evaluation.h"

namespace gnomon::cli {

/// A report for people: a line for each row, times also as multiples of the first that has one, `*` on the Pareto
/// front, and below what it was held against.
std::string evaluationTable(const EvaluationReport& report);

} // namespace gnomon::cli
