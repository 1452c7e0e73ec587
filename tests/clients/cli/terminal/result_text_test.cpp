#include "clients/cli/terminal/result_text.h"

#include <gtest/gtest.h>
#include <sstream>
#include <vector>

namespace gnomon::cli {
namespace {

std::vector<std::string> linesOf(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

TEST(EvaluationTable, TellsTimesAsMultiplesOfTheFirstAndErrorsInPercent) {
  EvaluationReport report;
  EvaluationRow hard;
  hard.name = "härt";
  hard.milliseconds = 20;
  hard.metrics.emplace();
  hard.metrics->misclassified = 0.0125;
  hard.metrics->falseShadow = 0.01;
  hard.metrics->falseLit = 0.0025;
  hard.metrics->edgeDisplacement = EdgeDisplacement{0.5, 0, 0, 0};
  hard.pareto = true;
  EvaluationRow slow = hard;
  slow.name = "slow";
  slow.milliseconds = 50;
  slow.metrics->edgeDisplacement.reset();
  slow.pareto = false;
  EvaluationRow refused;
  refused.name = "refused";
  refused.problems = {{"invalidValue", "/shadow", "No\x1b[31m such.", std::nullopt, std::nullopt}};
  report.rows = {hard, slow, refused};
  report.reference.frames = 1;
  const auto lines = linesOf(evaluationTable(report));
  ASSERT_GE(lines.size(), 6u);
  EXPECT_EQ(lines[0], "           ms     x  wrong %  false shadow %  false lit %  edge px");
  EXPECT_EQ(lines[1], "härt     20.0  1.00   1.2500          1.0000       0.2500     0.50  *");
  EXPECT_EQ(lines[2], "slow     50.0  2.50   1.2500          1.0000       0.2500        -");
  EXPECT_EQ(lines[3], "refused  /shadow: No?[31m such.");
  EXPECT_TRUE(lines[5].starts_with("Held against 1 traced frame (")) << lines[5];
}

} // namespace
} // namespace gnomon::cli
