#include "server/worker/render_thread.h"

#include <atomic>
#include <chrono>
#include <future>
#include <gtest/gtest.h>
#include <thread>

#include "tests/support/glb_builder.h"

namespace gnomon {
namespace {

class RenderThreads : public ::testing::Test {
 protected:
  RenderThreads() {
    RendererOptions options;
    options.backend.device = DeviceChoice::cpu;
    thread_ = *RenderThread::start(options);
    scene_ = *loadScene(testing::cube().bundle());
    spec_.width = spec_.height = 64;
    spec_.camera.lookAt = EyeTarget{};
  }

  /// Its PNG is finished on the render thread, which is busy until endLongFrame().
  void beginLongFrame() {
    std::promise<void> begun;
    longFrame_ = std::thread([&] {
      EXPECT_TRUE(thread_->renderAndFinish(
          scene_, spec_, [] { return true; },
          [&](DrawnFrame&) {
            begun.set_value();
            release_.get_future().wait();
          }));
    });
    begun.get_future().wait();
  }
  void endLongFrame() {
    release_.set_value();
    longFrame_.join();
  }

  std::unique_ptr<RenderThread> thread_;
  ScenePtr scene_;
  FrameSpec spec_;

 private:
  std::promise<void> release_;
  std::thread longFrame_;
};

TEST_F(RenderThreads, ALonePngIsFinishedWhereItWasDrawn) {
  std::thread::id by;
  ASSERT_TRUE(thread_->renderAndFinish(
      scene_, spec_, [] { return true; },
      [&](DrawnFrame& drawn) {
        by = std::this_thread::get_id();
        EXPECT_EQ(drawn.frame.images.size(), 1u);
      }));
  EXPECT_NE(by, std::this_thread::get_id());
  EXPECT_NE(by, std::thread::id());
}

TEST_F(RenderThreads, OtherFormatsAreFinishedByTheirCaller) {
  spec_.output.format = ImageFormat::jpeg;
  std::thread::id by;
  ASSERT_TRUE(thread_->renderAndFinish(
      scene_, spec_, [] { return true; }, [&](DrawnFrame&) { by = std::this_thread::get_id(); }));
  EXPECT_EQ(by, std::this_thread::get_id());
}

TEST_F(RenderThreads, WhileAnotherWaitsEachFinishesItsOwn) {
  std::thread other;
  std::atomic<bool> begun = false, asks = false;
  const auto goOn = [&] {
    if (begun.exchange(true)) return true;
    other = std::thread([&] {
      asks = true;
      EXPECT_TRUE(thread_->render(scene_, spec_, TileUse::kept, [] { return true; }));
    });
    while (!asks) std::this_thread::yield();
    std::this_thread::sleep_for(std::chrono::milliseconds(300)); // until it waits, surely
    return true;
  };
  std::thread::id by;
  EXPECT_TRUE(thread_->renderAndFinish(scene_, spec_, goOn, [&](DrawnFrame&) { by = std::this_thread::get_id(); }));
  other.join();
  EXPECT_EQ(by, std::this_thread::get_id());
}

TEST_F(RenderThreads, AFrameThatIsStoppedIsNotFinished) {
  bool finished = false;
  EXPECT_FALSE(thread_->renderAndFinish(
      scene_, spec_, [] { return false; }, [&](DrawnFrame&) { finished = true; }));
  EXPECT_FALSE(finished);
}

TEST_F(RenderThreads, WhoWaitsBehindAnotherMayGiveUp) {
  beginLongFrame();
  std::atomic<bool> isWanted = true;
  std::promise<bool> answer;
  std::thread second([&] {
    const auto drawn = thread_->render(scene_, spec_, TileUse::kept, [&] { return isWanted.load(); });
    EXPECT_TRUE(drawn || drawn.problems().front().code == ProblemCode::unavailable);
    answer.set_value(bool(drawn));
  });
  auto answered = answer.get_future();
  EXPECT_EQ(answered.wait_for(std::chrono::milliseconds(100)), std::future_status::timeout) << "still wanted";
  isWanted = false;
  EXPECT_EQ(answered.wait_for(std::chrono::seconds(10)), std::future_status::ready) << "while the other goes on";
  endLongFrame();
  second.join();
  EXPECT_FALSE(answered.get());
  EXPECT_TRUE(thread_->render(scene_, spec_, TileUse::kept, [] { return true; })) << "the thread goes on";
}

TEST_F(RenderThreads, WorkWhoseCallerGaveUpIsNeverRun) {
  beginLongFrame();
  // False once, then true: work that ran all the same would ask again, go on and finish.
  int asked = 0;
  bool finished = false;
  EXPECT_FALSE(thread_->renderAndFinish(
      scene_, spec_, [&] { return ++asked != 1; }, [&](DrawnFrame&) { finished = true; }));
  endLongFrame();
  EXPECT_TRUE(thread_->render(scene_, spec_, TileUse::kept, [] { return true; })) << "after what was left of the queue";
  EXPECT_EQ(asked, 1);
  EXPECT_FALSE(finished);
}

TEST_F(RenderThreads, WhatFinishingThrowsReachesTheCaller) {
  const auto fail = [](DrawnFrame&) { throw std::bad_alloc(); };
  EXPECT_THROW(static_cast<void>(thread_->renderAndFinish(
                   scene_, spec_, [] { return true; }, fail)),
               std::bad_alloc);
  EXPECT_TRUE(thread_->render(scene_, spec_, TileUse::kept, [] { return true; })) << "the thread goes on";
}

} // namespace
} // namespace gnomon
