#include "protocol/cost/passed_deadlines.h"

#include <gtest/gtest.h>

namespace gnomon {
namespace {

using Clock = PassedDeadlines::Clock;

constexpr Clock::time_point kNow{std::chrono::hours(1)};

FrameCost costOf(double volume, double shade = 1) {
  FrameCost cost;
  cost[FramePart::volume] = volume;
  cost[FramePart::shade] = shade;
  return cost;
}

TEST(PassedDeadlines, TheSecondIsABoundForFramesOfNoLessWork) {
  PassedDeadlines deadlines;
  deadlines.passed(costOf(10), 20'000, kNow);
  EXPECT_EQ(deadlines.atLeast(costOf(10), kNow), 0) << "what the first left finished may suffice";
  deadlines.passed(costOf(10), 20'000, kNow);
  EXPECT_EQ(deadlines.atLeast(costOf(10), kNow), 20'000);
  EXPECT_EQ(deadlines.atLeast(costOf(11, 2), kNow), 20'000);
  EXPECT_EQ(deadlines.atLeast(costOf(9, 100), kNow), 0) << "less in one part";
}

TEST(PassedDeadlines, OtherFramesProveNothing) {
  PassedDeadlines deadlines;
  deadlines.passed(costOf(10), 20'000, kNow);
  deadlines.passed(costOf(11), 20'000, kNow);
  EXPECT_EQ(deadlines.atLeast(costOf(11), kNow), 0);
}

TEST(PassedDeadlines, AFrameThatIsDoneRefutesThem) {
  PassedDeadlines deadlines;
  for (int i = 0; i < 2; ++i) deadlines.passed(costOf(10), 20'000, kNow);
  deadlines.done(costOf(5), 1'000);
  deadlines.done(costOf(12), 30'000);
  EXPECT_EQ(deadlines.atLeast(costOf(10), kNow), 20'000) << "less work, and longer: no contradiction";
  deadlines.done(costOf(10), 15'000);
  EXPECT_EQ(deadlines.atLeast(costOf(10), kNow), 0);
}

TEST(PassedDeadlines, TheyHoldForMinutes) {
  PassedDeadlines deadlines;
  for (int i = 0; i < 2; ++i) deadlines.passed(costOf(10), 20'000, kNow);
  EXPECT_EQ(deadlines.atLeast(costOf(10), kNow + std::chrono::minutes(9)), 20'000);
  EXPECT_EQ(deadlines.atLeast(costOf(10), kNow + std::chrono::minutes(11)), 0);
  deadlines.passed(costOf(10), 20'000, kNow + std::chrono::minutes(11));
  EXPECT_EQ(deadlines.atLeast(costOf(10), kNow + std::chrono::minutes(11)), 0) << "the old ones do not count";
}

TEST(PassedDeadlines, AreFew) {
  PassedDeadlines deadlines;
  for (int i = 0; i < 100; ++i) {
    for (int times = 0; times < 2; ++times) deadlines.passed(costOf(1'000 - i), 20'000, kNow);
  }
  EXPECT_EQ(deadlines.atLeast(costOf(901), kNow), 20'000);
  EXPECT_EQ(deadlines.atLeast(costOf(1), kNow), 0);
}

} // namespace
} // namespace gnomon
