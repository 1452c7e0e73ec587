#include <algorithm>
#include <cmath>

#include "protocol/base/text.h"
#include "renderer/charts/chart_parts.h"
#include "renderer/charts/charts.h"

namespace gnomon {
namespace {

using namespace svg;

constexpr double kPlotWidth = 560, kLegendWidth = 400;
constexpr double kLeft = 76, kTop = 48, kBottom = 56;
constexpr double kLeastHeight = 440, kLegendStep = 18;
constexpr double kRadius = 4;

/// A measured row in the picture.
struct Point {
  std::size_t row = 0;
  double x = 0, y = 0;
  bool front = false;
};

struct Box {
  double left, top, right, bottom;
};

bool overlap(const Box& a, const Box& b) {
  return a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
}

std::string percent(double share) {
  return shortNumber(100 * share) + " %";
}

const char* axisName(RankedError by) {
  return by == RankedError::rms ? "rms of the share of light" : "misclassified receivers";
}

/// Shares of receivers in percent, differences as they are.
std::string errorText(double error, RankedError by) {
  return by == RankedError::rms ? shortNumber(error) : percent(error);
}

std::string grid(const LogAxis& x, const ErrorAxis& y, double height, const ChartTime& time, RankedError by) {
  const double right = kPlotWidth - 16, bottom = height - kBottom;
  std::string out = text(kLeft, 24, "start", "Speed against error", " class=\"title\"");
  for (const double mark : y.marks()) {
    out += line("grid", kLeft, y.at(mark), right, y.at(mark));
    out += text(kLeft - 8, y.at(mark) + 4, "end", errorText(mark, by));
  }
  out += line("axis", kLeft, y.floor(), right, y.floor()) + text(kLeft - 8, y.floor() + 4, "end", "none");
  for (const double mark : x.marks()) {
    out += line("grid", x.at(mark), kTop, x.at(mark), bottom);
    out += text(x.at(mark), bottom + 18, "middle", number(mark));
  }
  const double middle = (kTop + bottom) / 2;
  out += text((kLeft + right) / 2, height - 14, "middle", time.axis);
  return out + text(18, middle, "middle", axisName(by), " transform=\"rotate(-90 18 " + number(middle) + ")\"");
}

/// From each row of the front to the next slower one: as wrong as before until there.
std::string frontLine(std::vector<Point> front) {
  std::sort(front.begin(), front.end(), [](const Point& a, const Point& b) { return a.x < b.x; });
  std::string places;
  for (std::size_t i = 0; i < front.size(); ++i) {
    if (i > 0) places += number(front[i].x) + "," + number(front[i - 1].y) + " ";
    places += number(front[i].x) + "," + number(front[i].y) + " ";
  }
  return front.size() < 2 ? "" : "<polyline points=\"" + places + "\" " + colored("line", 0) + "/>\n";
}

/// Where a point's number finds room beside it; over others where there is none.
Box placeNumber(const Point& point, const std::string& words, const std::vector<Box>& taken) {
  const double width = 7.0 * static_cast<double>(words.size()), height = 11;
  const auto boxAt = [&](double x, double y) { return Box{x, y, x + width, y + height}; };
  const double gap = kRadius + 2;
  for (const double reach : {1.0, 2.2, 3.6}) {
    const double d = gap * reach;
    for (const Box& box :
         {boxAt(point.x + d, point.y - height / 2), boxAt(point.x - d - width, point.y - height / 2),
          boxAt(point.x - width / 2, point.y - d - height), boxAt(point.x - width / 2, point.y + d),
          boxAt(point.x + d, point.y - d - height / 2), boxAt(point.x + d, point.y + d - height / 2),
          boxAt(point.x - d - width, point.y - d - height / 2), boxAt(point.x - d - width, point.y + d - height / 2)}) {
      if (std::none_of(taken.begin(), taken.end(), [&](const Box& other) { return overlap(box, other); })) return box;
    }
  }
  return boxAt(point.x + gap, point.y - height / 2);
}

std::string pointsOf(const EvaluationReport& report, const std::vector<Point>& points, const ChartTime& time) {
  std::string circles, numbers;
  std::vector<Box> taken;
  for (const Point& point : points) {
    taken.push_back({point.x - kRadius, point.y - kRadius, point.x + kRadius, point.y + kRadius});
    const EvaluationRow& row = report.rows[point.row];
    circles += "<circle cx=\"" + number(point.x) + "\" cy=\"" + number(point.y) + "\" r=\"" + number(kRadius) + "\" " +
               (point.front ? colored("fill", 0) : "class=\"fillRest\"") + "><title>" + escaped(row.name) + ": " +
               number(*row.milliseconds) + time.unit + ", " +
               errorText(errorOf(*row.metrics, report.rankedBy), report.rankedBy) + "</title></circle>\n";
  }
  for (const Point& point : points) {
    const std::string words = std::to_string(point.row + 1);
    const Box box = placeNumber(point, words, taken);
    taken.push_back(box);
    numbers += text(box.left, box.bottom - 1, "start", words, " class=\"small\"");
  }
  return circles + numbers;
}

std::string legendOf(const EvaluationReport& report, const ChartTime& time) {
  const double left = kPlotWidth + 8, right = kPlotWidth + kLegendWidth - 16;
  std::string out;
  double y = kTop + 6;
  for (std::size_t i = 0; i < report.rows.size(); ++i, y += kLegendStep) {
    const EvaluationRow& row = report.rows[i];
    const bool front = row.pareto.value_or(false);
    out += text(left + 20, y, "end", std::to_string(i + 1));
    const bool measured = row.milliseconds && row.metrics;
    out += text(left + 28, y, "start", shortened(row.name, measured ? 28 : 20), front ? " class=\"bold\"" : "");
    if (measured) {
      out += text(right - 84, y, "end", shortNumber(*row.milliseconds) + time.unit);
      out += text(right, y, "end", errorText(errorOf(*row.metrics, report.rankedBy), report.rankedBy));
    } else if (row.problems && !row.problems->empty()) {
      out += text(right, y, "end", shortened(row.problems->front().detail, 36), " class=\"small\"");
    }
  }
  return out;
}

} // namespace

std::string evaluationChart(const EvaluationReport& report, const ChartTime& time) {
  const double legend = kTop + kLegendStep * static_cast<double>(report.rows.size()) + 16;
  const double height = std::max(kLeastHeight, legend);
  std::vector<double> times, errors;
  for (const EvaluationRow& row : report.rows) {
    if (!row.milliseconds || !row.metrics) continue;
    times.push_back(*row.milliseconds);
    errors.push_back(errorOf(*row.metrics, report.rankedBy));
  }
  const LogAxis x(times, kLeft + 24, kPlotWidth - 40);
  const ErrorAxis y(errors, height - kBottom - 28, kTop + 16, height - kBottom);
  std::vector<Point> points;
  for (std::size_t i = 0; i < report.rows.size(); ++i) {
    const EvaluationRow& row = report.rows[i];
    if (!row.milliseconds || !row.metrics) continue;
    const double error = errorOf(*row.metrics, report.rankedBy);
    points.push_back({i, x.at(*row.milliseconds), y.at(error), row.pareto.value_or(false)});
  }
  std::vector<Point> front;
  std::copy_if(points.begin(), points.end(), std::back_inserter(front), [](const Point& point) { return point.front; });
  return document(kPlotWidth + kLegendWidth, height,
                  grid(x, y, height, time, report.rankedBy) + frontLine(front) + pointsOf(report, points, time) +
                      legendOf(report, time));
}

} // namespace gnomon
