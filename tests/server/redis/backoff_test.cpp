#include "server/redis/backoff.h"

#include <gtest/gtest.h>

namespace gnomon::redis {
namespace {

using std::chrono::milliseconds;

TEST(Backoff, DoublesUpToItsLongest) {
  EXPECT_EQ(backoffDelay(1, 1), milliseconds(50));
  EXPECT_EQ(backoffDelay(2, 1), milliseconds(100));
  EXPECT_EQ(backoffDelay(7, 1), milliseconds(3'200));
  EXPECT_EQ(backoffDelay(8, 1), milliseconds(5'000));
  EXPECT_EQ(backoffDelay(1'000'000, 1), milliseconds(5'000));
}

TEST(Backoff, IsBetweenHalfAndAllByChance) {
  EXPECT_EQ(backoffDelay(3, 0), milliseconds(100));
  EXPECT_EQ(backoffDelay(3, 0.5), milliseconds(150));
  EXPECT_EQ(backoffDelay(3, 1), milliseconds(200));
}

} // namespace
} // namespace gnomon::redis
