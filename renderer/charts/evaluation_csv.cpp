#include <algorithm>
#include <nlohmann/json.hpp>

#include "protocol/fields/field_checks.h"
#include "protocol/fields/field_codec.h"
#include "protocol/report/frame_report.h"
#include "renderer/charts/charts.h"

namespace gnomon {
namespace {

void appendLine(std::vector<std::string> fields, std::string& csv) {
  for (std::size_t i = 0; i < fields.size(); ++i) csv += (i > 0 ? "," : "") + csvField(fields[i]);
  csv += "\r\n";
}

/// The names of all stages, each where it first comes.
std::vector<std::string> stagesOf(const EvaluationReport& report) {
  std::vector<std::string> names;
  for (const EvaluationRow& row : report.rows) {
    for (const StageTime& stage : row.stages) {
      if (std::find(names.begin(), names.end(), stage.stage) == names.end()) names.push_back(stage.stage);
    }
  }
  return names;
}

/// JSON pointers of every metric, in the order of the rows.
std::vector<std::string> metricPointers() {
  ErrorMetrics all;
  all.edgeDisplacement.emplace();
  all.shimmer.emplace();
  all.predicted.emplace();
  all.predicted->edgeDisplacement.emplace();
  all.predicted->edgeLength.emplace();
  const Json flat = toJson(all).flatten();
  std::vector<std::string> pointers;
  for (const auto& [pointer, value] : flat.items()) pointers.push_back(pointer);
  return pointers;
}

std::string columnOf(const std::string& pointer) {
  std::string name = pointer.substr(1);
  std::replace(name.begin(), name.end(), '/', '.');
  return name;
}

std::string stageText(const EvaluationRow& row, const std::string& name) {
  for (const StageTime& stage : row.stages) {
    if (stage.stage == name) return numberText(stage.milliseconds);
  }
  return "";
}

std::string problemText(const EvaluationRow& row) {
  std::string text;
  if (!row.problems) return text;
  for (const VariantProblem& problem : *row.problems) {
    text += (text.empty() ? "" : "; ") + problem.pointer + (problem.pointer.empty() ? "" : ": ") + problem.detail;
  }
  return text;
}

} // namespace

std::string csvField(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

std::string evaluationCsv(const EvaluationReport& report) {
  const std::vector<std::string> stages = stagesOf(report);
  const std::vector<std::string> metrics = metricPointers();
  std::string csv;
  std::vector<std::string> head{"name", "problem", "milliseconds"};
  for (const std::string& stage : stages) head.push_back(stage + " ms");
  head.push_back("memoryBytes");
  for (const std::string& metric : metrics) head.push_back(columnOf(metric));
  head.push_back("pareto");
  appendLine(std::move(head), csv);
  for (const EvaluationRow& row : report.rows) {
    std::vector<std::string> fields{row.name, problemText(row)};
    fields.push_back(row.milliseconds ? numberText(*row.milliseconds) : "");
    for (const std::string& stage : stages) fields.push_back(stageText(row, stage));
    fields.push_back(row.metrics ? std::to_string(row.memoryBytes) : "");
    const Json values = row.metrics ? toJson(*row.metrics) : Json::object();
    for (const std::string& metric : metrics) {
      const Json::json_pointer pointer(metric);
      fields.push_back(values.contains(pointer) ? values[pointer].dump() : "");
    }
    fields.push_back(row.pareto ? (*row.pareto ? "true" : "false") : "");
    appendLine(std::move(fields), csv);
  }
  return csv;
}

} // namespace gnomon
