#pragma once

#include <span>
#include <vector>

/// Where values stand in a chart.
namespace gnomon {

/// A logarithmic axis between two places of the picture, which the least and the greatest value take.
class LogAxis {
 public:
  /// `values` > 0; none = 1..10.
  LogAxis(std::span<const double> values, double from, double to);

  double at(double value) const;
  std::vector<double> marks() const; ///< round numbers within it, at least 40 units of the picture apart

 private:
  double low_ = 1, high_ = 10, from_, to_;
};

/// A logarithmic axis of shares, which holds the marks of powers of ten, and a floor of its own for 0.
class ErrorAxis {
 public:
  /// `values` >= 0. Between `from` (the least above 0) and `to`; `floor` is where 0 stands.
  ErrorAxis(std::span<const double> values, double from, double to, double floor);

  double at(double value) const; ///< the floor for 0
  double floor() const { return floor_; }
  std::vector<double> marks() const; ///< powers of ten

 private:
  int lowPower_ = -3, highPower_ = -2;
  double from_, to_, floor_;
};

} // namespace gnomon
