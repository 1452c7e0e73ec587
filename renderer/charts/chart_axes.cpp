#include "renderer/charts/chart_axes.h"

#include <algorithm>
#include <cmath>

namespace gnomon {

LogAxis::LogAxis(std::span<const double> values, double from, double to) : from_(from), to_(to) {
  if (values.empty()) return;
  constexpr double kLeast = 1e-9; // a time of 0 is one that no clock could tell
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  low_ = std::max(*low, kLeast);
  high_ = std::max(*high, kLeast);
  constexpr double kLeastRatio = 1.25; // so that equal values stand in the middle
  if (high_ < low_ * kLeastRatio) {
    const double middle = std::sqrt(low_ * high_);
    low_ = middle / std::sqrt(kLeastRatio);
    high_ = low_ * kLeastRatio;
  }
}

double LogAxis::at(double value) const {
  return from_ + (to_ - from_) * std::log(std::max(value, low_) / low_) / std::log(high_ / low_);
}

std::vector<double> LogAxis::marks() const {
  constexpr double kApart = 40;
  // The roundest numbers come first; finer ones where there is room.
  std::vector<double> marks;
  const int first = static_cast<int>(std::floor(std::log10(low_)));
  const int last = static_cast<int>(std::ceil(std::log10(high_)));
  for (const std::vector<double>& digits : {std::vector<double>{1}, {2, 5}, {3, 4, 6, 7, 8, 9, 1.5, 2.5}, {1.2, 1.1}}) {
    for (int power = first; power <= last; ++power) {
      for (const double digit : digits) {
        const double mark = digit * std::pow(10.0, power);
        if (mark < low_ * (1 - 1e-9) || mark > high_ * (1 + 1e-9)) continue;
        const bool crowded = std::any_of(marks.begin(), marks.end(),
                                         [&](double other) { return std::abs(at(mark) - at(other)) < kApart; });
        if (!crowded) marks.push_back(mark);
      }
    }
  }
  std::sort(marks.begin(), marks.end());
  return marks;
}

ErrorAxis::ErrorAxis(std::span<const double> values, double from, double to, double floor)
    : from_(from), to_(to), floor_(floor) {
  double low = 0, high = 0;
  for (const double value : values) {
    if (value <= 0) continue;
    low = low > 0 ? std::min(low, value) : value;
    high = std::max(high, value);
  }
  if (high <= 0) return;
  lowPower_ = static_cast<int>(std::floor(std::log10(low)));
  highPower_ = std::max(static_cast<int>(std::ceil(std::log10(high))), lowPower_ + 1);
}

double ErrorAxis::at(double value) const {
  if (value <= 0) return floor_;
  return from_ + (to_ - from_) * (std::log10(value) - lowPower_) / (highPower_ - lowPower_);
}

std::vector<double> ErrorAxis::marks() const {
  std::vector<double> marks;
  for (int power = lowPower_; power <= highPower_; ++power) marks.push_back(std::pow(10.0, power));
  return marks;
}

} // namespace gnomon
