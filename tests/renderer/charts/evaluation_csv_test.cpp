#include <gtest/gtest.h>

#include "renderer/charts/charts.h"

namespace gnomon {
namespace {

std::vector<std::string> linesOf(const std::string& csv) {
  std::vector<std::string> lines;
  for (std::size_t begin = 0; begin < csv.size();) {
    const std::size_t end = csv.find("\r\n", begin);
    lines.push_back(csv.substr(begin, end - begin));
    begin = end + 2;
  }
  return lines;
}

TEST(EvaluationCsv, QuotesWhatNeedsIt) {
  EXPECT_EQ(csvField("plain text"), "plain text");
  EXPECT_EQ(csvField("a,b"), "\"a,b\"");
  EXPECT_EQ(csvField("say \"no\""), "\"say \"\"no\"\"\"");
  EXPECT_EQ(csvField("two\nlines"), "\"two\nlines\"");
  EXPECT_EQ(csvField(""), "");
}

TEST(EvaluationCsv, HasAColumnForEveryMetricAndStageAndAnEmptyFieldForWhatARowLacks) {
  EvaluationReport report;
  EvaluationRow good;
  good.name = "filter.type hard, cascadeCount 2";
  good.milliseconds = 12.5;
  good.stages = {{"shadow", 4}, {"shade", 8.5}};
  good.memoryBytes = 99;
  good.metrics.emplace();
  good.metrics->misclassified = 0.25;
  good.pareto = true;
  EvaluationRow bad;
  bad.name = "shadowVolume";
  bad.problems = {{"unsupportedFeature", "/shadow", "Masks, alas.", std::nullopt, std::nullopt}};
  bad.pareto = false;
  report.rows = {good, bad};
  const auto lines = linesOf(evaluationCsv(report));
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_EQ(lines[0],
            "name,problem,milliseconds,shadow ms,shade ms,memoryBytes,receivers,misclassified,falseShadow,falseLit,"
            "acne,leak,edge,interior,edgeDisplacement.mean,edgeDisplacement.median,edgeDisplacement.p95,"
            "edgeDisplacement.max,meanAbsolute,rms,shimmer,predicted.median,predicted.p95,predicted.max,"
            "predicted.edgeDisplacement,predicted.edgeLength,pareto");
  EXPECT_EQ(lines[1],
            "\"filter.type hard, cascadeCount 2\",,12.5,4,8.5,99,0,0.25,0.0,0.0,0.0,0.0,0.0,0.0,,,,,0.0,0.0,"
            ",,,,,,true");
  EXPECT_EQ(lines[2], "shadowVolume,\"/shadow: Masks, alas.\",,,,,,,,,,,,,,,,,,,,,,,,,false");
}

} // namespace
} // namespace gnomon
