#include "clients/cli/render/reference.h"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "protocol/evaluation/evaluation.h"
#include "protocol/json/json_codec.h"

namespace gnomon::cli {
namespace {

constexpr int kRaySamples = 256; // as many as an evaluation's reference takes

void makeExact(Shadow& shadow) {
  shadow.technique = ShadowTechnique::rayTraced;
  shadow.raySamples = std::max(shadow.raySamples, kRaySamples);
}

} // namespace

Result<FrameSpec> drawnSpec(const std::string& reportJson) {
  const Json report = Json::parse(reportJson, nullptr, false);
  if (!report.is_object() || !report.contains("spec")) {
    return Problem{ProblemCode::internal, "", "The frame's report has no request."};
  }
  return decodeFrameSpec(report["spec"].dump());
}

FrameSpec withExactShadows(FrameSpec spec) {
  spec.quality.reset();
  makeExact(spec.shadow);
  for (std::size_t i = 0; spec.lights && i < spec.lights->size(); ++i) {
    if (auto& shadow = (*spec.lights)[i].shadow) makeExact(*shadow);
  }
  return spec;
}

std::string errorRequest(FrameSpec spec) {
  spec.quality.reset();
  return Json{{"spec", toJson(spec)}, {"variants", {Json::object()}}, {"repeats", 1}}.dump();
}

std::string referenceName(const std::string& output) {
  std::filesystem::path path(output);
  const std::string suffix = path.extension();
  return path.replace_extension("reference" + suffix);
}

Result<ErrorMetrics> metricsOf(const EvaluationReport& measured) {
  if (measured.rows.empty()) return Problem{ProblemCode::internal, "", "The evaluation has no row."};
  const EvaluationRow& row = measured.rows.front();
  if (row.metrics) return *row.metrics;
  Problems problems;
  for (const VariantProblem& each : row.problems.value_or(std::vector<VariantProblem>())) {
    problems.push_back(invalidValue(each.pointer, each.detail, each.limit.value_or(""), each.actual.value_or("")));
  }
  if (problems.empty()) problems.push_back({ProblemCode::internal, "", "The frame could not be measured."});
  return problems;
}

std::string withMetrics(const std::string& reportJson, const EvaluationReport& measured) {
  Json report = Json::parse(reportJson);
  report["reference"] = Json{{"metrics", toJson(measured.rows.front())["metrics"]}};
  return report.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

} // namespace gnomon::cli
