#include "server/process/descriptor_plan.h"

#include <gtest/gtest.h>
#include <string>

namespace gnomon {
namespace {

TEST(DescriptorPlan, WhatIsAtWorkAndWhatWaitsNeverNeedMoreThanThereAre) {
  for (const std::size_t descriptors : {900u, 1'024u, 4'096u, 1'048'576u}) {
    for (const bool inMemory : {false, true}) {
      const auto plan = planDescriptors(descriptors, 128, 2, inMemory);
      ASSERT_TRUE(plan) << descriptors;
      EXPECT_LT(plan->waitingConnections + plan->scenesInMemory + 128 * 5, descriptors);
      EXPECT_GE(plan->waitingConnections, 32u);
      EXPECT_GE(plan->jobs, 16u);
      EXPECT_EQ(plan->scenesInMemory > 0, inMemory);
    }
  }
  EXPECT_EQ(planDescriptors(1'048'576, 128, 2, false)->waitingConnections, 2'048u);
}

TEST(DescriptorPlan, TooFewAreAProblemThatSaysHowManyItTakes) {
  const auto plan = planDescriptors(256, 128, 2, false);
  ASSERT_FALSE(plan);
  EXPECT_GE(std::stoul(plan.problems().front().limit), 128u * 5);
  EXPECT_EQ(plan.problems().front().actual, "256");
  EXPECT_TRUE(planDescriptors(256, 8, 2, false));
}

} // namespace
} // namespace gnomon
