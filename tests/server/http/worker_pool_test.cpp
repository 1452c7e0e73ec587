#include "server/http/worker_pool.h"

#include <atomic>
#include <chrono>
#include <future>
#include <gtest/gtest.h>
#include <set>
#include <thread>

namespace gnomon {
namespace {

TEST(WorkerPool, RefusesWhenEveryThreadIsTaken) {
  WorkerPool pool(2);
  std::promise<void> release;
  const auto released = release.get_future().share();
  std::atomic<int> refusedRuns = 0;
  EXPECT_TRUE(pool.tryRun([released] { released.wait(); }));
  EXPECT_TRUE(pool.tryRun([released] { released.wait(); }));
  EXPECT_FALSE(pool.tryRun([&] { ++refusedRuns; }));
  release.set_value();
  pool.shutdown();
  EXPECT_EQ(refusedRuns, 0);
  EXPECT_FALSE(pool.tryRun([&] { ++refusedRuns; }));
}

TEST(WorkerPool, RunsWhatItAcceptedBeforeItEnds) {
  std::atomic<int> runs = 0;
  int accepted = 0;
  {
    WorkerPool pool(4);
    for (int i = 0; i < 100; ++i) {
      accepted += pool.tryRun([&] { ++runs; }) ? 1 : 0;
    }
  }
  EXPECT_EQ(runs, accepted);
  EXPECT_GE(accepted, 4);
}

TEST(WorkerPool, TasksOneAfterTheOtherKeepToFewThreads) {
  WorkerPool pool(16);
  std::set<std::thread::id> threads;
  for (int i = 0; i < 100; ++i) {
    std::promise<std::thread::id> ran;
    ASSERT_TRUE(pool.tryRun([&ran] { ran.set_value(std::this_thread::get_id()); }));
    threads.insert(ran.get_future().get());
    std::this_thread::sleep_for(std::chrono::milliseconds(1)); // it is idle again, or very nearly so
  }
  EXPECT_LE(threads.size(), 4u);
}

} // namespace
} // namespace gnomon
