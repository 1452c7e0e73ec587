#include "renderer/core/stop.h"

#include <atomic>
#include <chrono>
#include <gtest/gtest.h>
#include <thread>

#include "renderer/core/parallel.h"

namespace gnomon {
namespace {

using std::chrono::milliseconds;

/// Passes the time in which nobody is asked again.
void pause() {
  std::this_thread::sleep_for(milliseconds(3));
}

TEST(Stop, ATaskThatIsNotStoppedReturnsWhatItDoes) {
  const Result<int> seven = untilStopped([] { return true; },
                                         [] {
                                           stopIfAsked();
                                           return Result<int>(7);
                                         });
  ASSERT_TRUE(seven);
  EXPECT_EQ(*seven, 7);
}

TEST(Stop, AStoppedTaskIsAProblem) {
  const Result<int> none = untilStopped([] { return false; },
                                        [] {
                                          stopIfAsked();
                                          return Result<int>(7);
                                        });
  ASSERT_FALSE(none);
  EXPECT_EQ(none.problems().front().code, ProblemCode::unavailable);
}

TEST(Stop, NobodyListensOutsideOfATask) {
  stopIfAsked();
  const Status done = untilStopped([] { return false; }, [] { return Status(Done{}); });
  EXPECT_TRUE(done);
  EXPECT_EQ(Stop::current(), nullptr);
}

TEST(Stop, PiecesOfALoopListenOnEveryThread) {
  std::atomic<bool> wanted = true;
  std::atomic<int> begun = 0;
  const Status stopped = untilStopped([&] { return wanted.load(); },
                                      [&] {
                                        forEach(1000, [&](std::size_t) {
                                          if (++begun == 20) wanted = false;
                                          pause();
                                        });
                                        return Status(Done{});
                                      });
  EXPECT_FALSE(stopped);
  EXPECT_LT(begun, 200);
}

TEST(Stop, ATaskWithinATaskListensToItsOwnAndThenToTheOuterOneAgain) {
  const Status outer = untilStopped([] { return true; },
                                    [] {
                                      Stop* const own = Stop::current();
                                      const Status inner = untilStopped([] { return false; },
                                                                        [] {
                                                                          stopIfAsked();
                                                                          return Status(Done{});
                                                                        });
                                      EXPECT_FALSE(inner);
                                      EXPECT_EQ(Stop::current(), own);
                                      stopIfAsked();
                                      return Status(Done{});
                                    });
  EXPECT_TRUE(outer);
}

TEST(Stop, ATaskThatNobodyAsksAboutListensToTheOuterOne) {
  const Status outer = untilStopped([] { return false; },
                                    [] {
                                      return untilStopped({}, [] {
                                        stopIfAsked();
                                        return Status(Done{});
                                      });
                                    });
  EXPECT_FALSE(outer);
}

TEST(Stop, IsAskedByOneThreadAtATimeAndSeldom) {
  std::atomic<int> asking = 0, most = 0, times = 0;
  const auto goOn = [&] {
    most = std::max(most.load(), ++asking);
    ++times;
    std::this_thread::sleep_for(milliseconds(1));
    --asking;
    return true;
  };
  const auto start = std::chrono::steady_clock::now();
  const Status done = untilStopped(goOn, [&] {
    forEach(100000, [](std::size_t) {});
    return Status(Done{});
  });
  const double took = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  EXPECT_TRUE(done);
  EXPECT_EQ(most, 1);
  EXPECT_LE(times, 1 + took / 2) << "no more often than every two milliseconds";
}

TEST(Stop, AThreadThatWaitsForAMutexIsStopped) {
  std::timed_mutex mutex;
  const std::unique_lock held(mutex);
  Status stopped = Done{};
  std::thread([&] {
    stopped = untilStopped([] { return false; },
                           [&] {
                             const auto lock = lockUnlessStopped(mutex);
                             return Status(Done{});
                           });
  }).join();
  EXPECT_FALSE(stopped);
}

} // namespace
} // namespace gnomon
