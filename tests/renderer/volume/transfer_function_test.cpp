#include <gtest/gtest.h>
#include <limits>
#include <rapidcheck.h>

#include "renderer/volume/medium.h"
#include "tests/renderer/volume/media.h"

namespace gnomon {
namespace {

const std::vector<TransferPoint> kTwo{{1, {{0, 0.5, 1}, 2}}, {3, {{1, 0.5, 0}, 6}}};

TEST(TransferFunction, IsLinearBetweenItsPointsAndConstantBeyond) {
  const TransferFunction function = *makeTransferFunction(kTwo);
  EXPECT_EQ(matterOf(function, -1e300).extinction, 2);
  EXPECT_EQ(matterOf(function, 1).extinction, 2);
  EXPECT_EQ(matterOf(function, 1.5).extinction, 3);
  EXPECT_EQ(matterOf(function, 1.5).color, glm::dvec3(0.25, 0.5, 0.75));
  EXPECT_EQ(matterOf(function, 3).extinction, 6);
  EXPECT_EQ(matterOf(function, 1e300).extinction, 6);
}

TEST(TransferFunction, OnePointIsEnoughAndValuesMayBeAsFarApartAsNumbersAre) {
  EXPECT_EQ(matterOf(*makeTransferFunction({{5, {glm::dvec3(1), 7}}}), -3).extinction, 7);
  const double most = std::numeric_limits<double>::max();
  const TransferFunction wide = *makeTransferFunction({{-most, {glm::dvec3(1), 0}}, {most, {glm::dvec3(1), 8}}});
  EXPECT_EQ(matterOf(wide, 0).extinction, 4);
}

TEST(TransferFunction, EverythingWrongIsNamedByItsPlace) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto refused = makeTransferFunction({{nan, {{0, 2, 0}, 1}}, {1, {{0, 0, nan}, -1}}, {1, {glm::dvec3(0), 2e6}}});
  ASSERT_FALSE(refused);
  std::vector<std::string> places;
  for (const Problem& problem : refused.problems()) places.push_back(problem.pointer);
  EXPECT_EQ(places, (std::vector<std::string>{"/0/value", "/0/color/1", "/1/color/2", "/1/extinction", "/2/extinction",
                                              "/2/value"}));
  EXPECT_FALSE(makeTransferFunction({}));
  std::vector<TransferPoint> points(257);
  for (int i = 0; i < 257; ++i) points[static_cast<std::size_t>(i)].value = i;
  EXPECT_EQ(makeTransferFunction(points).problems().front().limit, "1..256");
  points.pop_back();
  EXPECT_TRUE(makeTransferFunction(points));
}

TEST(TransferFunction, NoValueOfARangeIsAboveItsLargestExtinction) {
  EXPECT_TRUE(rc::check([](unsigned seed) {
    Chances chances(seed);
    std::vector<TransferPoint> points;
    for (int i = 0, count = 1 + chances.below(6); i < count; ++i) {
      points.push_back({i + chances.between(0, 0.9), {glm::dvec3(1), chances.below(2) * chances.between(0, 9)}});
    }
    const TransferFunction function = *makeTransferFunction(points);
    const double low = chances.between(-1, 7), high = low + chances.between(0, 3);
    const double bound = largestExtinction(function, low, high);
    double found = 0;
    for (int i = 0; i <= 1000; ++i)
      found = std::max(found, matterOf(function, low + (high - low) * i / 1000).extinction);
    RC_ASSERT(found <= bound + 1e-12);
    RC_ASSERT(found >= bound - 0.5);
    RC_ASSERT(bound <= largestExtinction(function));
  }));
}

} // namespace
} // namespace gnomon
