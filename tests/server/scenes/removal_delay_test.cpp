#include "server/scenes/removal_delay.h"

#include <gtest/gtest.h>

namespace gnomon {
namespace {

using std::chrono::minutes;

TEST(RemovalDelay, ATenthGoesAtOnceAndMoreATenthOfTheAgeLater) {
  RemovalDelay delay(minutes(10));
  const Clock::time_point start{};
  EXPECT_TRUE(delay.mayGo(0, 0, start));
  EXPECT_TRUE(delay.mayGo(2, 20, start));
  EXPECT_FALSE(delay.mayGo(3, 20, start));
  EXPECT_FALSE(delay.mayGo(20, 20, start + minutes(1) - std::chrono::milliseconds(1)));
  EXPECT_TRUE(delay.mayGo(20, 20, start + minutes(1)));
  EXPECT_TRUE(delay.mayGo(15, 15, start + minutes(2))) << "a pass may remove a part";
}

TEST(RemovalDelay, IsOverOnceTheClockIsRight) {
  RemovalDelay delay(minutes(10));
  const Clock::time_point start{};
  EXPECT_FALSE(delay.mayGo(20, 20, start));
  EXPECT_TRUE(delay.mayGo(1, 20, start + minutes(1)));
  EXPECT_FALSE(delay.mayGo(20, 20, start + minutes(2))) << "a delay of its own";
}

} // namespace
} // namespace gnomon
