#include "server/process/memory_plan.h"

#include <gtest/gtest.h>

namespace gnomon {
namespace {

constexpr std::uint64_t kGiB = 1u << 30;

std::uint64_t kept(const ServeOptions& options) {
  return options.sceneMemoryBytes + options.frameMemoryBytes + options.tracedSceneBytes + options.uploadMemoryBytes +
         options.gpuSceneBytes + options.bundleMemoryBytes + options.replyMemoryBytes + options.tileCacheBytes +
         options.lightMapBytes + options.volumeBytes + options.replyCacheBytes + options.jobBytes +
         options.videoMemoryBytes;
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
      EXPECT_LE(workers * workerBytes(options, workers, memory) + options.uploadMemoryBytes + options.replyMemoryBytes +
                    options.videoMemoryBytes,
                memory);
    }
  }
}

TEST(MemoryPlan, WorkersFollowCoresAndMemory) {
  EXPECT_EQ(usualWorkers(1, 16 * kGiB), 2u);
  EXPECT_EQ(usualWorkers(16, 16 * kGiB), 4u);
  EXPECT_EQ(usualWorkers(64, kGiB), 2u);
  EXPECT_EQ(usualWorkers(64, kGiB / 4), 1u);
}

} // namespace
} // namespace gnomon
