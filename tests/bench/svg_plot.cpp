#include "tests/bench/svg_plot.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace gnomon::bench {
namespace {

constexpr double kWidth = 720, kHeight = 400;
constexpr double kLeft = 64, kRight = 16, kTop = 64, kBottom = 56; // around the axes

// Colors are written out, not held in variables, which some viewers do not know.
constexpr const char* kStyle = R"(<style>
  text { font: 13px sans-serif; fill: #24292f } .title { font-size: 16px; font-weight: bold }
  .grid { stroke: #d0d7de } .axis { stroke: #24292f } polyline { fill: none; stroke-width: 2 }
  .fill0 { fill: #0969da } .fill1 { fill: #cf222e } .fill2 { fill: #1a7f37 } .fill3 { fill: #8250df }
  .line0 { stroke: #0969da } .line1 { stroke: #cf222e } .line2 { stroke: #1a7f37 } .line3 { stroke: #8250df }
  @media (prefers-color-scheme: dark) {
    text { fill: #e6edf3 } .grid { stroke: #3d444d } .axis { stroke: #e6edf3 }
    .fill0 { fill: #58a6ff } .fill1 { fill: #ff7b72 } .fill2 { fill: #56d364 } .fill3 { fill: #d2a8ff }
    .line0 { stroke: #58a6ff } .line1 { stroke: #ff7b72 } .line2 { stroke: #56d364 } .line3 { stroke: #d2a8ff }
  }
</style>
)";

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '&' ? "&amp;" : std::string(1, c);
  return out;
}

std::string text(double x, double y, const std::string& anchor, const std::string& words,
                 const std::string& more = "") {
  return "<text x=\"" + number(x) + "\" y=\"" + number(y) + "\" text-anchor=\"" + anchor + "\"" + more + ">" +
         escaped(words) + "</text>\n";
}

std::string line(const std::string& kind, double x1, double y1, double x2, double y2) {
  return "<line class=\"" + kind + "\" x1=\"" + number(x1) + "\" y1=\"" + number(y1) + "\" x2=\"" + number(x2) +
         "\" y2=\"" + number(y2) + "\"/>\n";
}

/// The class of a line's color.
std::string colored(const std::string& kind, std::size_t index) {
  return "class=\"" + kind + std::to_string(index % 4) + "\"";
}

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
  const std::string size = number(kWidth) + " " + number(kHeight);
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + size + "\" width=\"" + number(kWidth) +
         "\" height=\"" + number(kHeight) + "\">\n" + kStyle + frameOf(plot, axes) +
         (axes.bars ? barsOf(plot, axes) : linesOf(plot, axes)) + "</svg>\n";
}

} // namespace gnomon::bench
