#include "renderer/evaluation/pareto.h"

#include <algorithm>

namespace gnomon {
namespace {

bool measured(const EvaluationRow& row) {
  return row.milliseconds && row.metrics;
}

bool beats(const EvaluationRow& a, const EvaluationRow& b) {
  const double timeA = *a.milliseconds, timeB = *b.milliseconds;
  const double errorA = a.metrics->misclassified, errorB = b.metrics->misclassified;
  return timeA <= timeB && errorA <= errorB && (timeA < timeB || errorA < errorB);
}

} // namespace

void markPareto(std::vector<EvaluationRow>& rows) {
  for (EvaluationRow& row : rows) {
    row.pareto = measured(row) && std::none_of(rows.begin(), rows.end(), [&](const EvaluationRow& other) {
                   return measured(other) && beats(other, row);
                 });
  }
}

} // namespace gnomon
