#pragma once

#include <optional>
#include <string_view>

#include "protocol/base/result.h"
#include "protocol/evaluation/evaluation.h"
#include "protocol/json/json_codec.h"

namespace gnomon {

/// An EvaluationRequest from untrusted JSON, as strictly as decodeFrameSpec. Each variant is laid over the spec as it
/// was written, and must give a good spec; its problems point into /variants/i, those of a sweep's at /sweep.
Result<Evaluation> decodeEvaluation(std::string_view json);

Json toJson(const EvaluationReport& report);
Json toJson(const EvaluationRow& row);
Json toJson(const EvaluationStep& step);

/// The report that a server wrote as JSON; what it says beyond our rows is passed over. Nothing = it is no report.
std::optional<EvaluationReport> readEvaluationReport(std::string_view json);

} // namespace gnomon
