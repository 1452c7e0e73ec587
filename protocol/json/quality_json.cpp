#include "protocol/json/quality_json.h"

#include <nlohmann/json.hpp>

#include "protocol/fields/field_decode.h"
#include "protocol/fields/field_encode.h"
#include "protocol/report/metric_rows.h"

namespace gnomon {

Json toJson(const QualityReport& report) {
  return encodeValue(report);
}

std::optional<QualityReport> readQualityReport(std::string_view json) {
  ProblemList problems;
  QualityReport report;
  const std::optional<JsonNode> root = readJson(json, problems);
  if (!root || !decodeValue(*root, Notes{}, Place(), problems, report) || !problems.empty()) return std::nullopt;
  if (report.chosen >= report.tried.size()) return std::nullopt;
  return report;
}

} // namespace gnomon
