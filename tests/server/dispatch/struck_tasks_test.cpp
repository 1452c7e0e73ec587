// What becomes of requests that end workers, and of those beside them.
#include <atomic>
#include <csignal>
#include <thread>

#include "server/dispatch/strike_list.h"
#include "tests/server/dispatch/dispatcher_fixture.h"

namespace gnomon {
namespace {

using namespace std::chrono_literals;
using testing::kStays;

class StruckTasks : public testing::DispatcherTest {
 protected:
  static std::uint64_t replacedBy(const Dispatcher& dispatcher) {
    std::uint64_t all = 0;
    for (const std::uint64_t each : dispatcher.state().replacements) all += each;
    return all;
  }

  /// A frame that ends its worker, unlike every other number's.
  Task fatal(int number) const { return frame("fault-abort " + std::to_string(number)); }
};

TEST_F(StruckTasks, WhatEndedTwoWorkersIsNotTriedAThirdTime) {
  const auto dispatcher = start(1);
  EXPECT_EQ(problemOf(dispatcher->run(of("a", fatal(0)), kStays)), "internal");
  EXPECT_EQ(replacedBy(*dispatcher), 2u);
  for (const char* client : {"a", "b"}) {
    const TaskResult again = dispatcher->run(of(client, fatal(0)), kStays);
    EXPECT_EQ(problemOf(again), "internal");
    EXPECT_NE(again.outcome.problems[0].detail.find("Two workers ended over this request."), std::string::npos);
    EXPECT_NE(again.outcome.problems[0].detail.find("not tried again before"), std::string::npos);
    EXPECT_GT(again.outcome.retryAfterSeconds, 200);
  }
  EXPECT_EQ(replacedBy(*dispatcher), 2u);
  EXPECT_EQ(problemOf(dispatcher->run(of("a", frame()), kStays)), "");
}

TEST_F(StruckTasks, AClientCostsAFewWorkersAMinute) {
  const auto dispatcher = start(1);
  int number = 0;
  TaskResult last;
  for (; number < 10 && problemOf(last) != "busy"; ++number) {
    last = dispatcher->run(of("hostile", fatal(number)), kStays);
  }
  EXPECT_EQ(number, 3);
  EXPECT_EQ(last.refusal, TaskRefusal::client);
  EXPECT_GT(last.outcome.retryAfterSeconds, 30);
  EXPECT_EQ(replacedBy(*dispatcher), StrikeList::kClientEnds);
  EXPECT_EQ(problemOf(dispatcher->run(of("honest", frame()), kStays)), "");
}

TEST_F(StruckTasks, LeavingDoesNotHideWhoEndedAWorker) {
  const auto dispatcher = start(1, {.stopping = 50ms});
  for (std::size_t i = 0; i < StrikeList::kClientEnds; ++i) {
    while (dispatcher->state().ready == 0) std::this_thread::sleep_for(1ms);
    const std::uint64_t before = replacedBy(*dispatcher);
    const Task loop = of("hostile", frame("fault-loop " + std::to_string(i)));
    dispatcher->run(loop, [&] { return dispatcher->state().running > 0; });
    while (replacedBy(*dispatcher) == before) std::this_thread::sleep_for(1ms);
  }
  EXPECT_EQ(problemOf(dispatcher->run(of("hostile", frame()), kStays)), "busy");
  EXPECT_EQ(problemOf(dispatcher->run(of("honest", frame()), kStays)), "");
}

TEST_F(StruckTasks, WhatRanBesideAnEndedWorkerCountsAgainstNoClient) {
  const auto dispatcher = start(1);
  std::atomic<bool> done = false;
  std::thread honest([&] {
    while (!done) EXPECT_EQ(problemOf(dispatcher->run(of("honest", frame()), kStays)), "");
  });
  for (int i = 0; i < 8; ++i) {
    EXPECT_NE(problemOf(dispatcher->run(of("client " + std::to_string(i), fatal(i)), kStays)), "");
  }
  done = true;
  honest.join();
}

/// As of an evaluation whose worker another request ends.
TEST_F(StruckTasks, WhatHasSentEventsIsTriedAgainAndSendsNoneTwice) {
  const auto dispatcher = start(1);
  std::vector<std::string> events;
  Task evaluation = frame("fault-events");
  evaluation.order.kind = OrderKind::evaluation;
  evaluation.order.mediaType = kEventStream;
  const TaskResult result =
      dispatcher->run(evaluation, kStays, [&](const OrderEvent& event) { events.push_back(event.data); });
  EXPECT_EQ(problemOf(result), "internal");
  EXPECT_NE(result.outcome.problems[0].detail.find("Two workers"), std::string::npos);
  EXPECT_EQ(events, (std::vector<std::string>{"0", "1", "2"}));
}

} // namespace
} // namespace gnomon
