#include <gtest/gtest.h>
#include <string>

#include "server/process/admin_address.h"
#include "server/process/resource_plan.h"

namespace gnomon {
namespace {

constexpr std::uint64_t kGiB = 1u << 30;

std::uint64_t kept(const ServeOptions& options) {
  return options.sceneMemoryBytes + options.frameMemoryBytes + options.tracedSceneBytes + options.uploadMemoryBytes +
         options.gpuSceneBytes + options.bundleMemoryBytes + options.replyMemoryBytes + options.tileCacheBytes +
         options.lightMapBytes + options.volumeBytes + options.environmentBytes + options.replyCacheBytes +
         options.jobBytes + options.videoMemoryBytes;
}

TEST(MemoryPlan, BudgetsTogetherFitIntoTheMemory) {
  for (const std::uint64_t memory : {kGiB / 2, kGiB, 4 * kGiB, 16 * kGiB, 256 * kGiB}) {
    EXPECT_LE(kept(fittedTo(memory)), memory * 7 / 8) << memory;
  }
  EXPECT_EQ(kept(fittedTo(256 * kGiB)), kept(ServeOptions())) << "more than enough changes nothing";
}

TEST(MemoryPlan, AnUploadFitsIntoTheMemoryForUploads) {
  for (const std::uint64_t memory : {kGiB / 2, kGiB, 64 * kGiB}) {
    EXPECT_LE(2 * fittedTo(memory).maxSceneBytes, fittedTo(memory).uploadMemoryBytes);
  }
}

TEST(MemoryPlan, WorkersAndTheProcessThatListensFitTogether) {
  for (const std::uint64_t memory : {kGiB, 4 * kGiB, 64 * kGiB}) {
    for (const int cores : {1, 2, 16, 64}) {
      const ServeOptions options = fittedTo(memory);
      const std::size_t workers = usualWorkers(cores, memory);
      const std::uint64_t each = workerBytes(options, workers, memory);
      EXPECT_LE(workers * (each + vdbReaderBytes(each)) + options.uploadMemoryBytes + options.replyMemoryBytes +
                    options.videoMemoryBytes,
                memory);
      EXPECT_GE(vdbReaderBytes(each), 32u << 20) << "a reader without a file takes 12 MB";
    }
  }
}

TEST(MemoryPlan, WorkersFollowCoresAndMemory) {
  EXPECT_EQ(usualWorkers(1, 16 * kGiB), 2u);
  EXPECT_EQ(usualWorkers(16, 16 * kGiB), 4u);
  EXPECT_EQ(usualWorkers(64, kGiB), 2u);
  EXPECT_EQ(usualWorkers(64, kGiB / 4), 1u);
}

constexpr DescriptorUse kUse{.httpThreads = 128, .workers = 2, .jobFrames = 2};

TEST(DescriptorPlan, WhatIsAtWorkAndWhatWaitsNeverNeedMoreThanThereAre) {
  for (const std::size_t descriptors : {900u, 1'024u, 4'096u, 1'048'576u}) {
    for (const bool inMemory : {false, true}) {
      DescriptorUse use = kUse;
      use.keepsScenesInMemory = inMemory;
      const auto plan = planDescriptors(descriptors, use);
      ASSERT_TRUE(plan) << descriptors;
      EXPECT_LT(plan->waitingConnections + plan->waitingReplies + plan->scenesInMemory + plan->jobs + 128 * 5 +
                    kAdminThreads + kAdminWaiting,
                descriptors);
      EXPECT_GE(plan->waitingConnections, 32u);
      EXPECT_GE(plan->waitingReplies, 16u);
      EXPECT_GE(plan->jobs, 16u);
      EXPECT_EQ(plan->scenesInMemory > 0, inMemory);
    }
  }
  EXPECT_EQ(planDescriptors(1'048'576, kUse)->waitingConnections, 2'048u);
}

TEST(DescriptorPlan, TooFewAreAProblemThatSaysHowManyItTakes) {
  const auto plan = planDescriptors(256, kUse);
  ASSERT_FALSE(plan);
  EXPECT_GE(std::stoul(plan.problems().front().limit), 128u * 5);
  EXPECT_EQ(plan.problems().front().actual, "256");
  EXPECT_TRUE(planDescriptors(256, {.httpThreads = 8, .workers = 2, .jobFrames = 2}));
}

TEST(DescriptorPlan, WhatIsFewerForWantOfFilesIsNamed) {
  const DescriptorPlan few = *planDescriptors(4'096, kUse);
  const std::string shortage = shortageOf(few, 4'096);
  for (const std::string& part :
       {std::string("4096 open files"), std::to_string(few.waitingReplies) + " of 1024 replies",
        std::to_string(few.waitingConnections) + " of 2048 connections", std::to_string(few.jobs) + " of 256 jobs"})
    EXPECT_NE(shortage.find(part), std::string::npos) << shortage;
  EXPECT_LT(few.waitingReplies, 1'024u);
  EXPECT_EQ(shortageOf(*planDescriptors(20'000, kUse), 20'000), "");
}

TEST(DescriptorPlan, FramesOfJobsHaveTheirFiles) {
  DescriptorUse use = kUse;
  use.jobFrames = 512; // each has at least a request and a reply
  const auto refused = planDescriptors(1'024, use);
  ASSERT_FALSE(refused);
  EXPECT_GE(std::stoul(refused.problems().front().limit), 128u * 5 + 512u * 2);
  const auto plan = planDescriptors(4'096, use);
  ASSERT_TRUE(plan);
  EXPECT_LT(plan->waitingConnections, planDescriptors(4'096, kUse)->waitingConnections);
  EXPECT_LE(plan->waitingConnections + plan->jobs + 128 * 5 + 512 * 2, 4'096u);
}

} // namespace
} // namespace gnomon
