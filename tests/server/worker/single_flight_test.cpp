#include "server/worker/single_flight.h"

#include <atomic>
#include <gtest/gtest.h>
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
