#include "tests/bench/svg_plot.h"

#include <algorithm>
#include <cmath>

#include "renderer/charts/chart_parts.h"

namespace gnomon::bench {
namespace {

using namespace svg;

constexpr double kWidth = 720, kHeight = 400;
constexpr double kLeft = 64, kRight = 16, kTop = 64, kBottom = 56; // around the axes

/// 1, 2 or 5 times a power of ten: the step of about five marks up to `highest`.
double markStep(double highest) {
  const double rough = highest / 5;
  const double power = std::pow(10, std::floor(std::log10(rough)));
  for (const double step : {1.0, 2.0, 5.0}) {
    if (step * power >= rough) return step * power;
  }
  return 10 * power;
}

/// From values to places in the picture.
struct Axes {
  double lowX = 0, highX = 1; ///< of what `place` gives
  double highY = 1;
  bool bars = false;

  double x(const Plot& plot, std::size_t index) const {
    const double inner = kWidth - kLeft - kRight;
    if (bars) return kLeft + inner * (static_cast<double>(index) + 0.5) / static_cast<double>(plot.labels.size());
    const double share = highX > lowX ? (std::log(plot.xs[index]) - lowX) / (highX - lowX) : 0.5;
    return kLeft + 24 + (inner - 48) * share;
  }
  double y(double value) const { return kHeight - kBottom - (kHeight - kTop - kBottom) * value / highY; }
};

Axes axesOf(const Plot& plot) {
  Axes axes;
  axes.bars = plot.xs.empty();
  if (!axes.bars) {
    const auto [low, high] = std::minmax_element(plot.xs.begin(), plot.xs.end());
    axes.lowX = std::log(*low);
    axes.highX = std::log(*high);
  }
  double highest = 0;
  for (const PlotLine& each : plot.lines) {
    for (const auto& value : each.values) highest = std::max(highest, value.value_or(0));
  }
  highest = highest > 0 ? highest : 1;
  const double step = markStep(highest);
  axes.highY = step * std::ceil(highest / step);
  return axes;
}

std::string frameOf(const Plot& plot, const Axes& axes) {
  std::string out = text(kLeft, 22, "start", plot.title, " class=\"title\"");
  const double step = markStep(axes.highY);
  for (double mark = 0; mark < axes.highY + 0.5 * step; mark += step) {
    out += line(mark > 0 ? "grid" : "axis", kLeft, axes.y(mark), kWidth - kRight, axes.y(mark));
    out += text(kLeft - 8, axes.y(mark) + 4, "end", number(mark));
  }
  for (std::size_t i = 0; i < plot.labels.size(); ++i) {
    out += text(axes.x(plot, i), kHeight - kBottom + 18, "middle", plot.labels[i]);
  }
  out += text((kLeft + kWidth - kRight) / 2, kHeight - 12, "middle", plot.xLabel);
  const double middle = (kTop + kHeight - kBottom) / 2;
  out += text(16, middle, "middle", plot.yLabel, " transform=\"rotate(-90 16 " + number(middle) + ")\"");
  double x = kLeft;
  for (std::size_t i = 0; i < plot.lines.size(); ++i) {
    out += "<rect x=\"" + number(x) + "\" y=\"36\" width=\"12\" height=\"12\" " + colored("fill", i) + "/>\n";
    out += text(x + 18, 47, "start", plot.lines[i].name);
    x += 40 + 8.0 * static_cast<double>(plot.lines[i].name.size());
  }
  return out;
}

std::string barsOf(const Plot& plot, const Axes& axes) {
  std::string out;
  const double slot = (kWidth - kLeft - kRight) / static_cast<double>(plot.labels.size());
  const double width = 0.7 * slot / static_cast<double>(plot.lines.size());
  for (std::size_t l = 0; l < plot.lines.size(); ++l) {
    for (std::size_t i = 0; i < plot.lines[l].values.size(); ++i) {
      if (!plot.lines[l].values[i]) continue;
      const double x = axes.x(plot, i) - 0.35 * slot + width * static_cast<double>(l);
      const double y = axes.y(*plot.lines[l].values[i]);
      out += "<rect x=\"" + number(x) + "\" y=\"" + number(y) + "\" width=\"" + number(width) + "\" height=\"" +
             number(axes.y(0) - y) + "\" " + colored("fill", l) + "/>\n";
    }
  }
  return out;
}

std::string linesOf(const Plot& plot, const Axes& axes) {
  std::string out;
  for (std::size_t l = 0; l < plot.lines.size(); ++l) {
    std::string points;
    std::string marks;
    for (std::size_t i = 0; i < plot.lines[l].values.size(); ++i) {
      if (!plot.lines[l].values[i]) continue;
      const std::string x = number(axes.x(plot, i));
      const std::string y = number(axes.y(*plot.lines[l].values[i]));
      points += x + "," + y + " ";
      marks += "<circle cx=\"" + x + "\" cy=\"" + y + "\" r=\"4\" " + colored("fill", l) + "/>\n";
    }
    out += "<polyline points=\"" + points + "\" " + colored("line", l) + "/>\n" + marks;
  }
  return out;
}

} // namespace

std::string svgOf(const Plot& plot) {
  const Axes axes = axesOf(plot);
  return document(kWidth, kHeight, frameOf(plot, axes) + (axes.bars ? barsOf(plot, axes) : linesOf(plot, axes)));
}

} // namespace gnomon::bench
