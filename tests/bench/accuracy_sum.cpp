#include "tests/bench/accuracy_sum.h"

#include <algorithm>

#include "tests/bench/median.h"
#include "tests/bench/rounded.h"

namespace gnomon::bench {
namespace {

std::string percent(double share) {
  return rounded(100 * share, 4);
}

std::string orDash(const std::optional<double>& value) {
  return value ? rounded(*value, 2) : "-";
}

std::optional<double> medianOf(const std::vector<double>& values) {
  return values.empty() ? std::nullopt : std::optional(median(values));
}

} // namespace

AccuracySums::AccuracySums(const std::vector<Variant>& variants) {
  for (const Variant& variant : variants) {
    Sum sum;
    sum.name = variant.name;
    sums_.push_back(std::move(sum));
  }
}

void AccuracySums::add(const std::string& scene, const std::vector<EvaluationRow>& rows) {
  const EvaluationRow& first = rows.front();
  if (!first.metrics || !first.milliseconds || first.metrics->receivers == 0) return;
  names_.push_back(scene);
  First& kept = firsts_.emplace_back();
  kept.misclassified = first.metrics->misclassified;
  if (first.metrics->edgeDisplacement) kept.displacement = first.metrics->edgeDisplacement->mean;
  if (first.metrics->predicted) kept.predicted = first.metrics->predicted->edgeDisplacement;
  if (first.metrics->predicted) kept.texels = first.metrics->predicted->median;
  for (std::size_t i = 0; i < sums_.size(); ++i) {
    const EvaluationRow& row = rows[i];
    Sum& sum = sums_[i];
    if (!row.metrics || !row.milliseconds) {
      ++sum.refused;
      continue;
    }
    const auto receivers = static_cast<double>(row.metrics->receivers);
    sum.receivers += receivers;
    sum.wrong += receivers * row.metrics->misclassified;
    sum.falseShadow += receivers * row.metrics->falseShadow;
    sum.falseLit += receivers * row.metrics->falseLit;
    sum.interior += receivers * row.metrics->interior;
    sum.worst = std::max(sum.worst, row.metrics->misclassified);
    sum.ratios.push_back(*row.milliseconds / *first.milliseconds);
    if (row.metrics->edgeDisplacement) sum.displacements.push_back(row.metrics->edgeDisplacement->mean);
  }
}

EvaluationReport AccuracySums::report() const {
  EvaluationReport report;
  for (const Sum& sum : sums_) {
    EvaluationRow& row = report.rows.emplace_back();
    row.name = sum.name;
    if (sum.ratios.empty()) continue;
    row.milliseconds = median(sum.ratios);
    row.metrics = ErrorMetrics{};
    row.metrics->receivers = static_cast<std::uint64_t>(sum.receivers);
    row.metrics->misclassified = sum.wrong / sum.receivers;
    row.metrics->falseShadow = sum.falseShadow / sum.receivers;
    row.metrics->falseLit = sum.falseLit / sum.receivers;
    row.metrics->interior = sum.interior / sum.receivers;
  }
  return report;
}

std::string AccuracySums::table(const EvaluationReport& all) const {
  std::string out =
      "| shadows | x hard map | at most x | misclassified % | false shadow % | false lit % | interior % "
      "| worst scene % | edge, px | scenes refused |\n|---|---|---|---|---|---|---|---|---|---|\n";
  for (std::size_t i = 0; i < sums_.size(); ++i) {
    const EvaluationRow& row = all.rows[i];
    if (!row.metrics) continue;
    const char* const mark = row.pareto.value_or(false) ? "**" : "";
    out += "| " + (mark + sums_[i].name) + mark + " | " + rounded(*row.milliseconds, 2) + " | " +
           rounded(std::ranges::max(sums_[i].ratios), 2) + " | " + percent(row.metrics->misclassified) + " | " +
           percent(row.metrics->falseShadow) + " | " + percent(row.metrics->falseLit) + " | " +
           percent(row.metrics->interior) + " | " + percent(sums_[i].worst) + " | " +
           orDash(medianOf(sums_[i].displacements)) + " | " + std::to_string(sums_[i].refused) + " |\n";
  }
  return out;
}

std::string AccuracySums::sceneTable() const {
  std::string out = "| scene | misclassified by " + sums_.front().name +
                    ", % | its edges off, px | predicted, px | texels, px |\n|---|---|---|---|---|\n";
  for (std::size_t i = 0; i < names_.size(); ++i) {
    out += "| " + names_[i] + " | " + percent(firsts_[i].misclassified) + " | " + orDash(firsts_[i].displacement) +
           " | " + orDash(firsts_[i].predicted) + " | " + orDash(firsts_[i].texels) + " |\n";
  }
  return out;
}

} // namespace gnomon::bench
