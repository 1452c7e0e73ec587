#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

/// The pieces that charts are made of.
namespace gnomon::svg {

std::string number(double value); ///< four significant digits
std::string escaped(std::string_view text);

/// `anchor`: start, middle or end. `more`: further attributes, with a space in front.
std::string text(double x, double y, std::string_view anchor, std::string_view words, std::string_view more = "");
std::string line(std::string_view kind, double x1, double y1, double x2, double y2);

/// The class of something in one of four colors: `fill` or `line` and an index.
std::string colored(std::string_view kind, std::size_t index);

/// A whole file around `content`, readable on light and on dark ground (it follows the viewer's color scheme). Classes:
/// title, bold, small, grid, axis; fill0..3 and line0..3 in color, fillRest without.
std::string document(double width, double height, std::string_view content);

} // namespace gnomon::svg

/// Positions of values in a chart.
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
  /// `values` >= 0. Between `from` (the least above 0) and `to`; `floor` is the position of 0.
  ErrorAxis(std::span<const double> values, double from, double to, double floor);

  double at(double value) const; ///< the floor for 0
  double floor() const { return floor_; }
  std::vector<double> marks() const; ///< powers of ten

 private:
  int lowPower_ = -3, highPower_ = -2;
  double from_, to_, floor_;
};

} // namespace gnomon
