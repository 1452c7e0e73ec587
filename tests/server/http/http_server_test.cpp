#include "server/http/http_server.h"

#include <atomic>
#include <future>
#include <gtest/gtest.h>

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

} // namespace
} // namespace gnomon
