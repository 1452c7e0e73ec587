#include "renderer/core/parallel.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <fstream>
#include <gtest/gtest.h>
#include <thread>
#include <unistd.h>
#include <vector>

#include "tests/support/cpu_grant.h"

namespace gnomon {
namespace {

void write(const std::filesystem::path& file, const std::string& text) {
  std::filesystem::create_directories(file.parent_path());
  std::ofstream(file) << text;
}

class CpuQuota : public testing::Test {
 protected:
  std::filesystem::path root_ =
      std::filesystem::path(testing::TempDir()) / testing::UnitTest::GetInstance()->current_test_info()->name();
  void SetUp() override { std::filesystem::remove_all(root_); }
  void TearDown() override { std::filesystem::remove_all(root_); }
};

TEST_F(CpuQuota, readsCpuMax) {
  EXPECT_EQ(coresOfCpuMax("150000 100000\n"), 1.5);
  EXPECT_EQ(coresOfCpuMax("max 100000\n"), std::nullopt);
  EXPECT_EQ(coresOfCpuMax("-1 100000"), std::nullopt);
  EXPECT_EQ(coresOfCpuMax("1000 0"), std::nullopt);
  EXPECT_EQ(coresOfCpuMax(""), std::nullopt);
}

TEST_F(CpuQuota, takesTheTightestOfBothVersions) {
  write(root_ / "a/cpu.max", "200000 100000");
  write(root_ / "a/b/cpu.max", "400000 100000");
  write(root_ / "c/cpu.cfs_quota_us", "300000\n");
  write(root_ / "c/cpu.cfs_period_us", "100000\n");
  EXPECT_EQ(coresGranted({root_, root_ / "a", root_ / "a/b"}), 2.0);
  EXPECT_EQ(coresGranted({root_ / "a/b", root_ / "c"}), 3.0);
  EXPECT_EQ(coresGranted({root_, root_ / "d"}), std::nullopt);
}

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

TEST(Parallel, ALoopOfAnotherThreadDoesNotWaitForALongOne) {
  const auto cores = static_cast<std::size_t>(coresToUse());
  std::atomic<bool> isOver = false;
  std::atomic<std::size_t> begun = 0;
  std::thread longOne([&] {
    forEach(64 * cores, [&](std::size_t) {
      ++begun;
      while (!isOver) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    });
  });
  while (begun < cores) std::this_thread::yield(); // every thread that may help is in it
  std::size_t sum = 0;
  std::thread shortOne([&] {
    std::atomic<std::size_t> counted = 0;
    forEach(100, [&](std::size_t) { ++counted; });
    sum = counted;
    isOver = true;
  });
  shortOne.join();
  longOne.join();
  EXPECT_EQ(sum, 100u);
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
