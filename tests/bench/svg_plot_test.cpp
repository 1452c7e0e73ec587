#include "tests/bench/svg_plot.h"

#include <gtest/gtest.h>

namespace gnomon::bench {
namespace {

std::size_t countOf(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

TEST(SvgPlot, EveryMeasuredValueHasItsMark) {
  const Plot plot{"Cost & more", "cascades", "floors", {"1", "2", "4"}, {1, 2, 4}, {{"whole", {2.0, 3.0, {}}}}};
  const std::string svg = svgOf(plot);
  EXPECT_EQ(countOf(svg, "<circle"), 2u);
  EXPECT_EQ(countOf(svg, "<polyline"), 1u);
  EXPECT_NE(svg.find("Cost &amp; more"), std::string::npos);
  EXPECT_EQ(countOf(svg, "nan") + countOf(svg, "inf"), 0u);
}

TEST(SvgPlot, LogarithmicPlacesAreEvenlyApartForPowersOfTwoAndTheHighestMarkHoldsTheHighestValue) {
  const Plot plot{"", "", "", {"1", "2", "4"}, {1, 2, 4}, {{"whole", {4.1, 0.0, 0.0}}}};
  const std::string svg = svgOf(plot);
  EXPECT_NE(svg.find("cx=\"88\""), std::string::npos);
  EXPECT_NE(svg.find("cx=\"384\""), std::string::npos);
  EXPECT_NE(svg.find("cx=\"680\""), std::string::npos);
  EXPECT_NE(svg.find(">5</text>"), std::string::npos);
}

TEST(SvgPlot, NamesGetBarsAndNothingMeasuredGetsNone) {
  const std::string svg = svgOf({"", "", "", {"hard", "pcf"}, {}, {{"whole", {1.0, {}}}, {"shade", {0.5, {}}}}});
  EXPECT_EQ(countOf(svg, "<rect"), 2u + 2u) << "two of the legend";
  EXPECT_EQ(countOf(svgOf({"", "", "", {"hard"}, {}, {{"whole", {{}}}}}), "<rect"), 1u);
}

} // namespace
} // namespace gnomon::bench
