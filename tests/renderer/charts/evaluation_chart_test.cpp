#include <gtest/gtest.h>
#include <regex>

#include "renderer/charts/chart_parts.h"
#include "renderer/charts/charts.h"

namespace gnomon {
namespace {

EvaluationRow row(const std::string& name, double milliseconds, double misclassified, bool pareto = false) {
  EvaluationRow made;
  made.name = name;
  made.milliseconds = milliseconds;
  made.metrics.emplace();
  made.metrics->misclassified = misclassified;
  made.pareto = pareto;
  return made;
}

std::size_t countOf(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

/// Elements open and close in pairs, and nothing stands outside of them that would be no XML.
void expectWellFormed(const std::string& svg) {
  std::vector<std::string> open;
  const std::regex tag(R"(<(/?)([a-z]+)((?:\s+[a-zA-Z0-9:-]+="[^"<]*")*)\s*(/?)>)");
  std::size_t tags = 0;
  for (auto at = std::sregex_iterator(svg.begin(), svg.end(), tag); at != std::sregex_iterator(); ++at, ++tags) {
    const std::smatch& match = *at;
    if (match[1] == "/") {
      ASSERT_FALSE(open.empty());
      EXPECT_EQ(open.back(), match[2]);
      open.pop_back();
    } else if (match[4] != "/") {
      open.push_back(match[2]);
    }
  }
  EXPECT_TRUE(open.empty());
  EXPECT_EQ(tags, countOf(svg, "<"));
  EXPECT_EQ(countOf(svg, "nan") + countOf(svg, "inf"), 0u);
}

TEST(EvaluationChart, EveryMeasuredRowHasAPointAndEveryRowALineOfTheLegend) {
  EvaluationReport report;
  EvaluationRow refused;
  refused.name = "a <b> & \"c\"";
  refused.problems = {{"invalidValue", "/shadow", "It is so & so < ever.", std::nullopt, std::nullopt}};
  report.rows = {row("hard", 10, 0.01, true), row("exact", 40, 0, true), row("slow", 80, 0.02), refused};
  const std::string svg = evaluationChart(report);
  expectWellFormed(svg);
  EXPECT_EQ(countOf(svg, "<circle"), 3u);
  EXPECT_EQ(countOf(svg, "<polyline"), 1u);
  EXPECT_EQ(countOf(svg, ">slow<"), 1u);
  EXPECT_EQ(countOf(svg, "a &lt;b&gt; &amp; \"c\"<"), 1u);
  EXPECT_EQ(countOf(svg, "It is so &amp; so &lt; ever."), 1u);
}

TEST(EvaluationChart, ShowsTheErrorThatRowsAreRankedBy) {
  EvaluationReport report;
  report.rows = {row("1 ray", 10, 0.5, true), row("16 rays", 40, 0.5, true)};
  report.rows[0].metrics->rms = 0.04;
  report.rows[1].metrics->rms = 0.0101;
  report.rankedBy = RankedError::rms;
  const std::string svg = evaluationChart(report);
  expectWellFormed(svg);
  EXPECT_EQ(countOf(svg, ">rms of the share of light<"), 1u);
  EXPECT_EQ(countOf(svg, "misclassified") + countOf(svg, " %"), 0u);
  EXPECT_EQ(countOf(svg, ">0.04<"), 1u);
  const std::regex circle(R"re(<circle cx="([0-9.]+)" cy="([0-9.]+)")re");
  std::vector<double> heights;
  for (auto at = std::sregex_iterator(svg.begin(), svg.end(), circle); at != std::sregex_iterator(); ++at) {
    heights.push_back(std::stod((*at)[2]));
  }
  ASSERT_EQ(heights.size(), 2u);
  EXPECT_GT(heights[1], heights[0] + 50) << "a smaller error lies lower, though both misclassify the same";
}

TEST(EvaluationChart, NothingMeasuredAndAllTheSameAreChartsAsWell) {
  expectWellFormed(evaluationChart({}));
  EvaluationReport report;
  report.rows = {row("a", 5, 0, true), row("b", 5, 0, true)};
  expectWellFormed(evaluationChart(report));
  report.rows = {row("a", 0, 1e-9, true)};
  expectWellFormed(evaluationChart(report));
}

TEST(EvaluationChart, HoldsAsManyRowsAsAnEvaluationMayHave) {
  EvaluationReport report;
  for (int i = 0; i < 128; ++i) report.rows.push_back(row("row " + std::to_string(i), 10 + i, 0.001 * i));
  expectWellFormed(evaluationChart(report));
}

TEST(ChartAxes, TimesRunBetweenTheirEndsAndMarksLieWithin) {
  const double values[] = {7, 300, 40};
  const LogAxis axis(values, 100, 500);
  EXPECT_DOUBLE_EQ(axis.at(7), 100);
  EXPECT_DOUBLE_EQ(axis.at(300), 500);
  const auto marks = axis.marks();
  ASSERT_GE(marks.size(), 3u);
  for (std::size_t i = 1; i < marks.size(); ++i) EXPECT_GE(axis.at(marks[i]) - axis.at(marks[i - 1]), 40);
  EXPECT_GE(marks.front(), 7);
  EXPECT_LE(marks.back(), 300);
}

TEST(ChartAxes, AnErrorOfNothingStandsOnTheFloorAndPowersOfTenAreEvenlyApart) {
  const double values[] = {0, 0.0004, 0.03};
  const ErrorAxis axis(values, 300, 0, 340);
  EXPECT_EQ(axis.at(0), 340);
  const auto marks = axis.marks();
  ASSERT_EQ(marks.size(), 4u); // 0.0001 to 0.1
  EXPECT_NEAR(axis.at(0.0001), 300, 1e-9);
  EXPECT_NEAR(axis.at(0.001), 200, 1e-9);
  EXPECT_NEAR(axis.at(0.1), 0, 1e-9);
}

} // namespace
} // namespace gnomon
