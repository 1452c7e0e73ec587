#include "renderer/volume/transfer_function.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace gnomon {
namespace {

/// Whether `number` is in the range; NaN is not.
bool within(double number, double low, double high) {
  return number >= low && number <= high;
}

void check(const TransferPoint& point, const std::string& place, ProblemList& problems) {
  if (!std::isfinite(point.value)) {
    problems.add({ProblemCode::invalidValue, place + "/value", "A value is a finite number.", "finite",
                  std::to_string(point.value)});
  }
  for (int i = 0; i < 3; ++i) {
    if (within(point.matter.color[i], 0, 1)) continue;
    problems.add({ProblemCode::invalidValue, place + "/color/" + std::to_string(i), "A color is out of its range.",
                  "0..1", std::to_string(point.matter.color[i])});
  }
  if (!within(point.matter.extinction, 0, kMaxExtinction)) {
    problems.add({ProblemCode::invalidValue, place + "/extinction", "An extinction is out of its range.",
                  "0..1000000 per metre", std::to_string(point.matter.extinction)});
  }
}

} // namespace

Result<TransferFunction> makeTransferFunction(std::vector<TransferPoint> points) {
  if (points.empty() || points.size() > kMaxTransferPoints) {
    return Problem{ProblemCode::invalidValue, "", "A transfer function has too few or too many points.",
                   "1.." + std::to_string(kMaxTransferPoints), std::to_string(points.size())};
  }
  ProblemList problems;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::string place = "/" + std::to_string(i);
    check(points[i], place, problems);
    if (i > 0 && points[i].value <= points[i - 1].value) {
      problems.add({ProblemCode::invalidValue, place + "/value", "The values of a transfer function increase.",
                    "> " + std::to_string(points[i - 1].value), std::to_string(points[i].value)});
    }
  }
  if (!problems.empty()) return std::move(problems).take();
  return TransferFunction{std::move(points)};
}

Matter matterOf(const TransferFunction& function, double value) {
  const auto& points = function.points;
  const auto next = std::upper_bound(points.begin(), points.end(), value,
                                     [](double v, const TransferPoint& point) { return v < point.value; });
  if (next == points.begin()) return points.front().matter;
  if (next == points.end()) return points.back().matter;
  const TransferPoint& last = *std::prev(next);
  // Halves, as the difference of two finite values may not be finite.
  const double share = (value / 2 - last.value / 2) / (next->value / 2 - last.value / 2);
  return {glm::mix(last.matter.color, next->matter.color, share),
          glm::mix(last.matter.extinction, next->matter.extinction, share)};
}

double largestExtinction(const TransferFunction& function, double low, double high) {
  double largest = std::max(matterOf(function, low).extinction, matterOf(function, high).extinction);
  for (const TransferPoint& point : function.points) {
    if (within(point.value, low, high)) largest = std::max(largest, point.matter.extinction);
  }
  return largest;
}

double largestExtinction(const TransferFunction& function) {
  double largest = 0;
  for (const TransferPoint& point : function.points) largest = std::max(largest, point.matter.extinction);
  return largest;
}

} // namespace gnomon
