#include "renderer/core/parallel.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <gtest/gtest.h>
#include <thread>
#include <unistd.h>
#include <vector>

#include "tests/support/cpu_grant.h"

namespace gnomon {
namespace {

TEST(Parallel, CallsEveryIndexOnce) {
  for (const std::size_t count : {0u, 1u, 7u, 1000u}) {
    std::vector<std::atomic<int>> calls(count);
    forEach(count, [&](std::size_t i) { ++calls[i]; });
    EXPECT_TRUE(std::all_of(calls.begin(), calls.end(), [](const auto& n) { return n == 1; })) << count;
  }
}

TEST(Parallel, CutsPiecesAsAsked) {
  std::atomic<std::size_t> covered = 0;
  std::atomic<int> pieces = 0;
  forEachPiece(10, 4, [&](std::size_t first, std::size_t last) {
    EXPECT_EQ(first % 4, 0u);
    EXPECT_EQ(last, std::min<std::size_t>(10, first + 4));
    covered += last - first;
    ++pieces;
  });
  EXPECT_EQ(covered, 10u);
  EXPECT_EQ(pieces, 3);
}

TEST(ParallelDeathTest, UsesAsManyThreadsAsItsControlGroupGrants) {
  if (!canGrantCores()) GTEST_SKIP() << "control groups can't be replaced here";
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const auto threadsWith = [](int cores) {
    grantCores(cores);
    forEach(64, [](std::size_t) { std::this_thread::sleep_for(std::chrono::milliseconds(2)); });
    _exit(threadCount());
  };
  EXPECT_EXIT(threadsWith(1), testing::ExitedWithCode(1), "");
  const int machine = static_cast<int>(std::thread::hardware_concurrency());
  EXPECT_EXIT(threadsWith(2), testing::ExitedWithCode(std::min(2, machine)), "");
}

} // namespace
} // namespace gnomon
