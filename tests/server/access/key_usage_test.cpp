#include "server/access/key_usage.h"

#include <gtest/gtest.h>

namespace gnomon {
namespace {

using std::chrono::milliseconds;

AccessKey limited(double requestsPerSecond, double burst, std::size_t concurrent = 0) {
  AccessKey key;
  key.name = "a";
  key.requestsPerSecond = requestsPerSecond;
  key.burst = burst;
  key.concurrent = concurrent;
  return key;
}

TEST(KeyUsage, ABurstAtOnceAndThenTheRate) {
  KeyUsage usage;
  const AccessKey key = limited(0.5, 3);
  const auto start = Clock::now();
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(usage.admit(key, start).place);
  const Admission refused = usage.admit(key, start);
  EXPECT_FALSE(refused.place);
  EXPECT_EQ(refused.retryAfterSeconds, 2);
  EXPECT_EQ(usage.wait(key, start + milliseconds(500)), 2) << "1.5 seconds, rounded up";
  EXPECT_FALSE(usage.admit(key, start + milliseconds(1'900)).place);
  EXPECT_TRUE(usage.admit(key, start + milliseconds(2'000)).place) << "what Retry-After said";
  EXPECT_FALSE(usage.admit(key, start + milliseconds(2'000)).place);
}

TEST(KeyUsage, WaitingSavesNoMoreThanABurst) {
  KeyUsage usage;
  const AccessKey key = limited(10, 2);
  const auto later = Clock::now() + std::chrono::hours(1);
  EXPECT_TRUE(usage.admit(key).place);
  for (int i = 0; i < 2; ++i) EXPECT_TRUE(usage.admit(key, later).place);
  EXPECT_FALSE(usage.admit(key, later).place);
}

TEST(KeyUsage, LookingTakesNothing) {
  KeyUsage usage;
  const AccessKey key = limited(1, 1, 1);
  const auto now = Clock::now();
  for (int i = 0; i < 5; ++i) EXPECT_EQ(usage.wait(key, now), 0);
  EXPECT_TRUE(usage.admit(key, now).place);
  EXPECT_EQ(usage.wait(key, now), 1);
}

TEST(KeyUsage, APlaceIsFreeAgainOnceItIsGivenBack) {
  KeyUsage usage;
  const AccessKey key = limited(0, 0, 2);
  Admission first = usage.admit(key);
  const Admission second = usage.admit(key);
  EXPECT_TRUE(first.place && second.place);
  const Admission third = usage.admit(key);
  EXPECT_FALSE(third.place);
  EXPECT_EQ(third.retryAfterSeconds, 1);
  first.place.reset();
  EXPECT_TRUE(usage.admit(key).place);
}

TEST(KeyUsage, EachKeyHasItsOwn) {
  KeyUsage usage;
  AccessKey other = limited(0, 0, 1);
  other.name = "b";
  const Admission first = usage.admit(limited(0, 0, 1));
  EXPECT_TRUE(first.place);
  EXPECT_TRUE(usage.admit(other).place);
}

TEST(KeyUsage, WithoutBoundsEverythingMayGoOn) {
  KeyUsage usage;
  std::vector<Admission> held;
  for (int i = 0; i < 1'000; ++i) held.push_back(usage.admit(limited(0, 0)));
  for (const Admission& each : held) EXPECT_TRUE(each.place);
}

} // namespace
} // namespace gnomon
