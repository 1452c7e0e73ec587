#include "server/http/transfer_pace.h"

#include <gtest/gtest.h>
#include <optional>

namespace gnomon {
namespace {

using namespace std::chrono_literals;

constexpr std::size_t kKibi = 1024;

/// When a transfer is ended that moves `bytes` every `step`, and how; nothing within the time.
struct Ended {
  TransferState state;
  Clock::duration after;
};
std::optional<Ended> endOf(TransferPace& pace, Clock::time_point start, std::size_t bytes, Clock::duration step,
                           Clock::duration time) {
  auto next = start; // the first step fills what is empty
  for (auto now = start; now < start + time; now += 50ms) {
    if (now >= next) {
      pace.moved(bytes, now);
      next += step;
    }
    if (const TransferState state = pace.state(now); state != TransferState::goesOn) return Ended{state, now - start};
    EXPECT_GE(pace.wait(now), now);
  }
  return std::nullopt;
}

std::optional<Ended> alone(std::size_t bytes, Clock::duration step, Clock::duration time = 30min) {
  const auto start = Clock::now();
  TransferPace pace({}, {}, {}, start);
  return endOf(pace, start, bytes, step, time);
}

TEST(TransferPace, EverySteadyReaderGoesOnHoweverItsMachineAcknowledges) {
  for (const std::size_t speed : {20, 50, 100, 256, 1000}) { // in steps of a packet to those of a window
    for (const std::size_t step : {2, 16, 64, 96, 390}) {
      const auto every = std::chrono::milliseconds(1000 * step / speed);
      EXPECT_FALSE(alone(step * kKibi, std::max<Clock::duration>(every, 1ms))) << step << " KiB at " << speed;
    }
  }
}

TEST(TransferPace, OneBelowTheLeastSpeedIsEnded) {
  const auto ended = alone(12 * kKibi, 1s);
  ASSERT_TRUE(ended);
  EXPECT_EQ(ended->state, TransferState::tooSlow);
  EXPECT_LT(ended->after, 1min);
}

TEST(TransferPace, OneThatDoesNotBeginIsEndedSoon) {
  const auto ended = alone(0, 1h);
  ASSERT_TRUE(ended);
  EXPECT_NEAR(std::chrono::duration<double>(ended->after).count(), 5, 0.1);
}

TEST(TransferPace, ABurstEarnsTwentySeconds) {
  const auto start = Clock::now();
  TransferPace pace({}, {}, {}, start);
  pace.moved(std::size_t{1} << 40, start);
  const auto ended = endOf(pace, start, 1, 500ms, 1h);
  ASSERT_TRUE(ended);
  EXPECT_NEAR(std::chrono::duration<double>(ended->after).count(), 20, 0.1);
}

TEST(TransferPace, WhatThereIsNothingToMoveInCostsNoTime) {
  const auto start = Clock::now();
  TransferPace pace({}, {}, {}, start);
  pace.paused(1h);
  EXPECT_EQ(pace.state(start + 1h + 4s), TransferState::goesOn);
  EXPECT_EQ(pace.state(start + 1h + 6s), TransferState::tooSlow);
}

/// A client that holds everything, and another one that may wait for it.
class WaitedFor : public ::testing::Test {
 protected:
  static constexpr std::size_t kBytes = 60 << 20; ///< to be done in 60 s: at 1 MiB a second

  std::optional<Ended> end(std::size_t bytesPerSecond, Clock::duration time) {
    const auto start = Clock::now();
    TransferPace pace({}, {&elsewhere_, &budget_}, holder_, start);
    return endOf(pace, start, bytesPerSecond / 10, 100ms, time);
  }

  const Holder holder_{{"a", "a"}, "1"};
  ByteBudget elsewhere_{kBytes}; ///< of which nothing is held: what a reply's other memory may be
  ByteBudget budget_{kBytes};
  ByteLease lease_{budget_, holder_};
  ByteLease other_{budget_, {{"b", "b"}, "2"}};
};

TEST_F(WaitedFor, ASlowTransferGoesOnWhileNoOtherWaits) {
  ASSERT_TRUE(lease_.grow(kBytes));
  EXPECT_FALSE(end(20 * kKibi, 10min));
}

TEST_F(WaitedFor, ASlowTransferIsEndedBeforeTheOtherGivesUp) {
  ASSERT_TRUE(lease_.grow(kBytes));
  ASSERT_FALSE(other_.grow(1));
  const auto ended = end(100 * kKibi, 1min);
  ASSERT_TRUE(ended);
  EXPECT_EQ(ended->state, TransferState::othersWaited);
  EXPECT_GT(ended->after, 3s) << "it had time to show its speed";
  EXPECT_LT(ended->after, 5s);
}

TEST_F(WaitedFor, AFastTransferGoesOn) {
  ASSERT_TRUE(lease_.grow(kBytes));
  ASSERT_FALSE(other_.grow(1));
  EXPECT_FALSE(end(1100 * kKibi, 1min));
}

TEST_F(WaitedFor, TheTransferOfWhoHoldsLessGoesOn) {
  ASSERT_TRUE(lease_.grow(kBytes / 3));
  ASSERT_TRUE(other_.grow(kBytes - kBytes / 3));
  ByteLease third(budget_, {{"c", "c"}, "3"});
  ASSERT_FALSE(third.grow(1));
  EXPECT_FALSE(end(20 * kKibi, 1min));
}

} // namespace
} // namespace gnomon
