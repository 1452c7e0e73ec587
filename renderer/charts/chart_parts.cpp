#include "renderer/charts/chart_parts.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace gnomon::svg {
namespace {

// Colors are written out, not held in variables, which some viewers do not know.
constexpr const char* kStyle = R"(<style>
  text { font: 13px sans-serif; fill: #24292f } .title { font-size: 16px; font-weight: bold } .small { font-size: 11px } .bold { font-weight: bold }
  .grid { stroke: #d0d7de } .axis { stroke: #24292f } polyline { fill: none; stroke-width: 2 }
  .fill0 { fill: #0969da } .fill1 { fill: #cf222e } .fill2 { fill: #1a7f37 } .fill3 { fill: #8250df }
  .line0 { stroke: #0969da } .line1 { stroke: #cf222e } .line2 { stroke: #1a7f37 } .line3 { stroke: #8250df }
  .fillRest { fill: #8c959f }
  @media (prefers-color-scheme: dark) {
    text { fill: #e6edf3 } .grid { stroke: #3d444d } .axis { stroke: #e6edf3 }
    .fill0 { fill: #58a6ff } .fill1 { fill: #ff7b72 } .fill2 { fill: #56d364 } .fill3 { fill: #d2a8ff }
    .line0 { stroke: #58a6ff } .line1 { stroke: #ff7b72 } .line2 { stroke: #56d364 } .line3 { stroke: #d2a8ff }
  }
</style>
)";

} // namespace

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    const char shown = static_cast<unsigned char>(c) < 0x20 ? ' ' : c; // control characters are no XML
    out += c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '&' ? "&amp;" : std::string(1, shown);
  }
  return out;
}

std::string text(double x, double y, std::string_view anchor, std::string_view words, std::string_view more) {
  return "<text x=\"" + number(x) + "\" y=\"" + number(y) + "\" text-anchor=\"" + std::string(anchor) + "\"" +
         std::string(more) + ">" + escaped(words) + "</text>\n";
}

std::string line(std::string_view kind, double x1, double y1, double x2, double y2) {
  return "<line class=\"" + std::string(kind) + "\" x1=\"" + number(x1) + "\" y1=\"" + number(y1) + "\" x2=\"" +
         number(x2) + "\" y2=\"" + number(y2) + "\"/>\n";
}

std::string colored(std::string_view kind, std::size_t index) {
  return "class=\"" + std::string(kind) + std::to_string(index % 4) + "\"";
}

std::string document(double width, double height, std::string_view content) {
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + number(width) + " " + number(height) +
         "\" width=\"" + number(width) + "\" height=\"" + number(height) + "\">\n" + kStyle + std::string(content) +
         "</svg>\n";
}

} // namespace gnomon::svg

namespace gnomon {

LogAxis::LogAxis(std::span<const double> values, double from, double to) : from_(from), to_(to) {
  if (values.empty()) return;
  constexpr double kLeast = 1e-9; // a time of 0 is below the clock's resolution
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  low_ = std::max(*low, kLeast);
  high_ = std::max(*high, kLeast);
  constexpr double kLeastRatio = 1.25; // so that equal values are in the middle
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
