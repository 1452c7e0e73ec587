#include "renderer/shadow/receiver_mask.h"

#include <gtest/gtest.h>

namespace gnomon {
namespace {

Aabb box(const glm::dvec3& low, const glm::dvec3& high) {
  Aabb result;
  result.add(low);
  result.add(high);
  return result;
}

TEST(ReceiverMask, M14_OnlyWhatStandsOverAReceiverAndBeforeItMayShadow) {
  const ReceiverMask mask = receiverMask({box({-0.5, -0.5, 0.4}, {-0.25, -0.25, 0.6})}, {0.0, 0.0});
  EXPECT_TRUE(mask.mayShadow(box({-0.4, -0.4, 0.1}, {-0.3, -0.3, 0.2})));
  EXPECT_TRUE(mask.mayShadow(box({-0.4, -0.4, -50}, {-0.3, -0.3, -40}))) << "before the tile";
  EXPECT_TRUE(mask.mayShadow(box({-9, -9, 0.6}, {9, 9, 0.9}))) << "a part of it lies between";
  EXPECT_FALSE(mask.mayShadow(box({-0.4, -0.4, 0.61}, {-0.3, -0.3, 0.7}))) << "behind the farthest receiver";
  EXPECT_FALSE(mask.mayShadow(box({0.1, -0.4, 0.1}, {0.2, -0.3, 0.2}))) << "beside";
  EXPECT_FALSE(mask.mayShadow(box({-3, -3, 0.1}, {-2, -2, 0.2}))) << "outside of the tile";
}

TEST(ReceiverMask, ALookupBesideAReceiverCounts) {
  const std::vector<Aabb> receiver{box({0.0, 0.0, 0.5}, {0.01, 0.01, 0.5})};
  const Aabb caster = box({0.2, 0.0, 0.1}, {0.21, 0.01, 0.1});
  EXPECT_FALSE(receiverMask(receiver, {0.05, 0.05}).mayShadow(caster));
  EXPECT_TRUE(receiverMask(receiver, {0.2, 0.05}).mayShadow(caster));
}

TEST(ReceiverMask, ACellKeepsItsFarthestReceiver) {
  const ReceiverMask mask =
      receiverMask({box({0, 0, 0.2}, {0.01, 0.01, 0.8}), box({0, 0, 0.1}, {0.01, 0.01, 0.3})}, {});
  EXPECT_TRUE(mask.mayShadow(box({0, 0, 0.7}, {0.01, 0.01, 0.7})));
}

} // namespace
} // namespace gnomon
