#include "server/frames/shared_frames.h"

#include <atomic>
#include <future>
#include <gtest/gtest.h>
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
      while (!release_ && !gone()) std::this_thread::sleep_for(1ms);
      return withStatus(release_ ? status : 503);
    };
  }

  Clock::time_point later() const { return Clock::now() + 60s; }

  SharedFrames frames_;
  std::atomic<int> drawn_ = 0;
  std::atomic<bool> release_ = false;
};

TEST_F(SharedFramesTest, OneIsDrawnForAll) {
  std::vector<std::future<HttpReply>> replies;
  for (int i = 0; i < 5; ++i) {
    replies.push_back(std::async(std::launch::async, [&] { return frames_.run("a", later(), kStays, drawing()); }));
  }
  while (drawn_ == 0) std::this_thread::sleep_for(1ms);
  std::this_thread::sleep_for(50ms);
  release_ = true;
  for (auto& reply : replies) EXPECT_EQ(reply.get().body, "picture");
  EXPECT_EQ(drawn_, 1);
  frames_.run("a", later(), kStays, drawing());
  EXPECT_EQ(drawn_, 2) << "nothing is remembered";
}

TEST_F(SharedFramesTest, ItGoesOnForThoseWhoJoined) {
  std::atomic<bool> left = false;
  auto first = std::async(std::launch::async, [&] {
    return frames_.run(
        "a", later(), [&] { return left.load(); }, drawing());
  });
  while (drawn_ == 0) std::this_thread::sleep_for(1ms);
  auto second = std::async(std::launch::async, [&] { return frames_.run("a", later(), kStays, drawing()); });
  std::this_thread::sleep_for(50ms);
  left = true;
  std::this_thread::sleep_for(50ms);
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
  while (drawn_ == 0) std::this_thread::sleep_for(1ms);
  auto second = std::async(std::launch::async, [&] { return frames_.run("a", later(), kStays, drawing(200)); });
  std::this_thread::sleep_for(50ms);
  release_ = true;
  EXPECT_EQ(first.get().status, 504);
  EXPECT_EQ(second.get().status, 200);
}

TEST_F(SharedFramesTest, AnEarlierDeadlineIsKept) {
  auto first = std::async(std::launch::async, [&] { return frames_.run("a", later(), kStays, drawing()); });
  while (drawn_ == 0) std::this_thread::sleep_for(1ms);
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
