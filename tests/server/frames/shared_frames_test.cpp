#include "server/frames/shared_frames.h"

#include <atomic>
#include <future>
#include <gtest/gtest.h>
#include <stdexcept>
#include <thread>
#include <vector>

namespace gnomon {
namespace {

using namespace std::chrono_literals;

const SharedFrames::Gone kStays = [] { return false; };

HttpReply withStatus(int status) {
  HttpReply reply;
  reply.status = status;
  reply.body = "picture";
  return reply;
}

class SharedFramesTest : public ::testing::Test {
 protected:
  /// A frame that is drawn until `release_` is set, or until nobody waits for it.
  std::function<HttpReply(const SharedFrames::Gone&)> drawing(int status = 200) {
    return [this, status](const SharedFrames::Gone& gone) {
      ++drawn_;
      while (!release_ && !gone()) {
        ++asked_;
        std::this_thread::sleep_for(1ms);
      }
      ++ended_;
      return withStatus(release_ ? status : 503);
    };
  }

  void untilDrawn() const {
    while (drawn_ == 0) std::this_thread::sleep_for(1ms);
  }

  void untilWaiting(int calls) const {
    while (frames_.waiting() < calls) std::this_thread::sleep_for(1ms);
  }

  /// Until the frame that is being drawn has asked from now on whether anybody waits: it goes on, or has ended.
  void untilAskedAnew() const {
    const int before = asked_;
    while (asked_ < before + 2 && ended_ == 0) std::this_thread::sleep_for(1ms); // the first may have begun earlier
  }

  Clock::time_point later() const { return Clock::now() + 60s; }

  SharedFrames frames_;
  std::atomic<int> drawn_ = 0;
  std::atomic<int> asked_ = 0; ///< times that `gone` said no
  std::atomic<int> ended_ = 0;
  std::atomic<bool> release_ = false;
};

TEST_F(SharedFramesTest, OneIsDrawnForAll) {
  std::vector<std::future<HttpReply>> replies;
  for (int i = 0; i < 5; ++i) {
    replies.push_back(std::async(std::launch::async, [&] { return frames_.run("a", later(), kStays, drawing()); }));
  }
  untilWaiting(4);
  release_ = true;
  for (auto& reply : replies) EXPECT_EQ(reply.get().body, "picture");
  EXPECT_EQ(drawn_, 1);
  EXPECT_EQ(frames_.shared(), 4u);
  frames_.run("a", later(), kStays, drawing());
  EXPECT_EQ(drawn_, 2) << "nothing is remembered";
}

TEST_F(SharedFramesTest, ItGoesOnForThoseWhoJoined) {
  std::atomic<bool> left = false;
  auto first = std::async(std::launch::async, [&] {
    return frames_.run(
        "a", later(), [&] { return left.load(); }, drawing());
  });
  untilDrawn();
  auto second = std::async(std::launch::async, [&] { return frames_.run("a", later(), kStays, drawing()); });
  untilWaiting(1);
  left = true;
  untilAskedAnew();
  release_ = true;
  EXPECT_EQ(second.get().status, 200);
  EXPECT_EQ(drawn_, 1);
}

TEST_F(SharedFramesTest, ItEndsWhenNobodyWaits) {
  const HttpReply reply = frames_.run(
      "a", later(), [] { return true; }, drawing());
  EXPECT_EQ(reply.status, 503);
}

TEST_F(SharedFramesTest, AProblemIsNobodyElses) {
  auto first = std::async(std::launch::async, [&] { return frames_.run("a", later(), kStays, drawing(504)); });
  untilDrawn();
  auto second = std::async(std::launch::async, [&] { return frames_.run("a", later(), kStays, drawing(200)); });
  untilWaiting(1);
  release_ = true;
  EXPECT_EQ(first.get().status, 504);
  EXPECT_EQ(second.get().status, 200);
}

TEST_F(SharedFramesTest, AnExceptionIsNobodyElsesAndNobodyWaitsForIt) {
  const auto begun = Clock::now();
  const auto throwing = [&](const SharedFrames::Gone& gone) -> HttpReply {
    drawing()(gone);
    throw std::runtime_error("no memory");
  };
  auto first = std::async(std::launch::async, [&] { return frames_.run("a", later(), kStays, throwing); });
  untilDrawn();
  auto second = std::async(std::launch::async, [&] { return frames_.run("a", later(), kStays, drawing()); });
  untilWaiting(1);
  release_ = true;
  EXPECT_THROW(first.get(), std::runtime_error);
  EXPECT_EQ(second.get().status, 200);
  EXPECT_EQ(frames_.run("a", later(), kStays, drawing()).status, 200) << "asked for later";
  EXPECT_EQ(drawn_, 3);
  EXPECT_EQ(frames_.waiting(), 0);
  EXPECT_LT(Clock::now() - begun, 30s) << "nobody waited for a deadline";
}

TEST_F(SharedFramesTest, AnEarlierDeadlineIsKept) {
  auto first = std::async(std::launch::async, [&] { return frames_.run("a", later(), kStays, drawing()); });
  untilDrawn();
  const auto begun = Clock::now();
  const HttpReply reply =
      frames_.run("a", begun + 50ms, kStays, [](const SharedFrames::Gone&) { return withStatus(504); });
  EXPECT_EQ(reply.status, 504);
  EXPECT_LT(Clock::now() - begun, 1s);
  release_ = true;
  first.get();
}

} // namespace
} // namespace gnomon
