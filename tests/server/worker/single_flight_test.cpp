#include "server/worker/single_flight.h"

#include <atomic>
#include <future>
#include <gtest/gtest.h>
#include <optional>
#include <stdexcept>
#include <thread>
#include <vector>

namespace gnomon {
namespace {

TEST(SingleFlight, RunsOnceForAllWhoAskMeanwhile) {
  SingleFlight<int> flights;
  std::atomic<int> runs = 0;
  std::promise<void> started, release;
  const auto work = [&] {
    ++runs;
    started.set_value();
    release.get_future().wait();
    return 7;
  };
  std::thread first([&] { EXPECT_EQ(flights.run("key", work), 7); });
  started.get_future().wait();
  std::vector<std::thread> others;
  for (int i = 0; i < 4; ++i) {
    others.emplace_back([&] { EXPECT_EQ(flights.run("key", [&] { return 7 + 0 * ++runs; }), 7); });
  }
  EXPECT_EQ(flights.run("other", [] { return 8; }), 8); // not held up
  release.set_value();
  first.join();
  for (std::thread& other : others) {
    other.join();
  }
}

TEST(SingleFlight, WhoWaitsForAnothersWorkMayGiveUp) {
  SingleFlight<int> flights;
  std::promise<void> started, release;
  std::thread first([&] {
    EXPECT_EQ(flights.run("key",
                          [&] {
                            started.set_value();
                            release.get_future().wait();
                            return 7;
                          }),
              7);
  });
  started.get_future().wait();
  bool ran = false;
  int asked = 0;
  const auto mine = [&] {
    ran = true;
    return 8;
  };
  EXPECT_EQ(flights.run("key", mine, [&] { return ++asked < 3; }), std::nullopt);
  EXPECT_EQ(asked, 3);
  EXPECT_FALSE(ran);
  release.set_value();
  first.join();
  EXPECT_EQ(flights.run("key", mine, [] { return false; }), 8) << "work of its own listens by itself";
}

TEST(SingleFlight, RemembersNothing) {
  SingleFlight<int> flights;
  EXPECT_EQ(flights.run("key", [] { return 1; }), 1);
  EXPECT_EQ(flights.run("key", [] { return 2; }), 2);
}

TEST(SingleFlight, LandsAfterAnException) {
  SingleFlight<int> flights;
  EXPECT_THROW(flights.run("key", []() -> int { throw std::runtime_error("x"); }), std::runtime_error);
  EXPECT_EQ(flights.run("key", [] { return 2; }), 2);
}

} // namespace
} // namespace gnomon
