#include "server/dispatch/dispatcher.h"

#include <algorithm>
#include <atomic>
#include <csignal>
#include <optional>
#include <set>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <thread>

#include "server/system/file_descriptor.h"
#include "tests/server/dispatch/dispatcher_fixture.h"

namespace gnomon {
namespace {

using namespace std::chrono_literals;
using testing::DispatcherTest;
using testing::kStays;

/// Tasks that hold a place each until `leave` is set.
std::vector<std::thread> holders(std::size_t count, Dispatcher& dispatcher, const Task& task,
                                 std::atomic<bool>& leave) {
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < count; ++i) {
    threads.emplace_back([&dispatcher, &leave, task] { dispatcher.run(task, [&] { return leave.load(); }); });
  }
  return threads;
}

/// Holds all places of a lone worker.
std::vector<std::thread> holdWorker(Dispatcher& dispatcher, const Task& task, std::atomic<bool>& leave) {
  auto threads = holders(kPlaces[0], dispatcher, task, leave);
  while (dispatcher.state().running < kPlaces[0]) std::this_thread::sleep_for(1ms);
  return threads;
}

TEST_F(DispatcherTest, DrawsFrames) {
  const auto dispatcher = start(2);
  EXPECT_EQ(dispatcher->info().backend, "cpu");
  const TaskResult result = dispatcher->run(frame(), kStays);
  ASSERT_EQ(problemOf(result), "");
  ASSERT_TRUE(result.body);
  EXPECT_EQ(result.body->view().substr(1, 3), "PNG");
  EXPECT_EQ(result.outcome.stages.front().stage, "queue");
}

TEST_F(DispatcherTest, WhatEndsItsWorkerTwiceIsAProblemAndHarmsNobodyElse) {
  const auto dispatcher = start(2);
  for (const char* fault : {"fault-abort", "fault-garbage"}) {
    std::atomic<bool> done = false;
    std::vector<std::thread> others;
    for (int i = 0; i < 3; ++i) {
      others.emplace_back([&] {
        while (!done) EXPECT_EQ(problemOf(dispatcher->run(frame(), kStays)), "");
      });
    }
    EXPECT_EQ(problemOf(dispatcher->run(of("hostile", frame(fault)), kStays)), "internal") << fault;
    done = true;
    for (std::thread& other : others) other.join();
  }
  EXPECT_EQ(problemOf(dispatcher->run(frame(), kStays)), "");
}

TEST_F(DispatcherTest, AKilledWorkersTasksAreTriedAgainButNotForEver) {
  const auto dispatcher = start(1);
  std::atomic<bool> done = false;
  std::thread asking([&] {
    EXPECT_EQ(problemOf(dispatcher->run(of("unlucky", frame("fault-loop")), kStays)), "internal");
    done = true;
  });
  std::set<pid_t> victims;
  while (!done) {
    std::this_thread::sleep_for(1ms);
    const pid_t worker = dispatcher->processes().at(0);
    if (worker > 0 && dispatcher->state().running > 0 && victims.insert(worker).second) ::kill(worker, SIGKILL);
  }
  asking.join();
  EXPECT_EQ(victims.size(), 5u);
  EXPECT_EQ(problemOf(dispatcher->run(frame(), kStays)), "");
}

/// As the first process of a container it inherits what its workers had started.
TEST_F(DispatcherTest, NothingIsLeftOfAKilledWorker) {
  ASSERT_EQ(::prctl(PR_SET_CHILD_SUBREAPER, 1, 0, 0, 0), 0);
  {
    const auto dispatcher = start(1);
    const pid_t victim = dispatcher->processes().at(0);
    ::kill(victim, SIGKILL);
    while (dispatcher->processes().at(0) == victim || dispatcher->state().ready == 0) std::this_thread::sleep_for(1ms);
    EXPECT_EQ(problemOf(dispatcher->run(frame(), kStays)), "");
    EXPECT_EQ(::waitpid(-victim, nullptr, WNOHANG), -1);
  }
  EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1);
  EXPECT_EQ(errno, ECHILD);
  ::prctl(PR_SET_CHILD_SUBREAPER, 0, 0, 0, 0);
}

TEST_F(DispatcherTest, TasksOutliveAllWorkersThatAreKilledAtOnce) {
  const auto dispatcher = start(2);
  std::atomic<bool> done = false;
  std::vector<std::thread> asking;
  for (int i = 0; i < 4; ++i) {
    asking.emplace_back([&] {
      while (!done) EXPECT_EQ(problemOf(dispatcher->run(frame(), kStays)), "");
    });
  }
  for (int i = 0; i < 5; ++i) {
    while (dispatcher->state().ready < 2) std::this_thread::sleep_for(1ms);
    std::this_thread::sleep_for(300ms);
    for (const pid_t worker : dispatcher->processes()) {
      if (worker > 0) ::kill(worker, SIGKILL);
    }
    while (dispatcher->state().ready == 2) std::this_thread::sleep_for(1ms);
  }
  done = true;
  for (std::thread& thread : asking) thread.join();
}

TEST_F(DispatcherTest, ATaskThatDoesNotStopCostsItsWorker) {
  const auto dispatcher = start(1, {.stopping = 200ms});
  const pid_t before = dispatcher->processes().at(0);
  Task loop = frame("fault-loop");
  loop.deadline = Clock::now() + 300ms;
  const auto begun = Clock::now();
  EXPECT_EQ(problemOf(dispatcher->run(loop, kStays)), "deadlineExceeded");
  EXPECT_LT(Clock::now() - begun, 500ms * 4) << "the answer does not wait for the worker's end";
  EXPECT_EQ(problemOf(dispatcher->run(frame(), kStays)), "");
  while (dispatcher->state().ready == 0) std::this_thread::sleep_for(1ms);
  while (dispatcher->processes().at(0) == before) std::this_thread::sleep_for(1ms);
  EXPECT_EQ(dispatcher->state().replacements, (std::array<std::uint64_t, kWorkerEnds>{0, 0, 1, 0}));
}

TEST_F(DispatcherTest, TellsHowLongEachTaskWaited) {
  std::atomic<int> told = 0;
  const auto dispatcher = start(1, {.waited = [&](Lane lane, double seconds) {
                                  EXPECT_EQ(lane, Lane::interactive);
                                  EXPECT_GE(seconds, 0);
                                  ++told;
                                }});
  for (int i = 0; i < 3; ++i) EXPECT_EQ(problemOf(dispatcher->run(frame(), kStays)), "");
  EXPECT_EQ(told, 3);
  EXPECT_GT(dispatcher->residentBytes(), 1u << 20);
}

TEST_F(DispatcherTest, WhatIsDoneWhileItsEventsAreHeardIsNotWaitedFor) {
  const auto dispatcher = start(1);
  const auto isRunning = [&] {
    const auto running = dispatcher->state().runningByLane;
    return std::any_of(running.begin(), running.end(), [](std::size_t count) { return count > 0; });
  };
  Clock::duration shortest = 1h;
  for (int i = 0; i < 5; ++i) {
    Task task = frame();
    task.order.kind = OrderKind::sequenceFrame;
    std::optional<Clock::time_point> done;
    const TaskResult result = dispatcher->run(task, kStays, [&](const OrderEvent&) {
      while (isRunning()) std::this_thread::sleep_for(100us);
      done = done.value_or(Clock::now());
    });
    ASSERT_EQ(problemOf(result), "");
    ASSERT_TRUE(done);
    shortest = std::min(shortest, Clock::now() - *done);
  }
  EXPECT_LT(shortest, 10ms);
}

TEST_F(DispatcherTest, WhoLeavesIsNotWaitedFor) {
  const auto dispatcher = start(1, {.stopping = 200ms});
  const auto begun = Clock::now();
  EXPECT_EQ(problemOf(dispatcher->run(frame("fault-loop"), [&] { return Clock::now() - begun > 100ms; })),
            "unavailable");
  EXPECT_LT(Clock::now() - begun, 1s);
}

TEST_F(DispatcherTest, ASilentWorkerIsReplaced) {
  const auto dispatcher = start(1, {.responseTimeout = 1500ms});
  EXPECT_EQ(problemOf(dispatcher->run(frame("fault-silence"), kStays)), "internal");
  EXPECT_EQ(problemOf(dispatcher->run(frame(), kStays)), "");
}

TEST_F(DispatcherTest, AWorkerThatTakesTooMuchMemoryIsReplaced) {
  DispatcherOptions options;
  options.each.memoryBytes = 1'000u << 20;
  const auto dispatcher = start(1, options);
  const TaskResult result = dispatcher->run(frame("fault-memory"), kStays);
  ASSERT_EQ(problemOf(result), "tooLarge");
  EXPECT_EQ(result.outcome.problems[0].limit, std::to_string(1'000u << 20) + " bytes");
  EXPECT_EQ(problemOf(dispatcher->run(frame(), kStays)), "");
}

TEST_F(DispatcherTest, TheQueueIsBoundedAndSaysWhenToComeAgain) {
  const auto dispatcher = start(1, {.queueLimit = 1, .stopping = 200ms});
  std::atomic<bool> leave = false;
  std::vector<std::thread> held = holders(kPlaces[0] + 1, *dispatcher, frame("fault-loop"), leave);
  while (dispatcher->state().waiting == 0) std::this_thread::sleep_for(1ms);
  std::this_thread::sleep_for(1200ms);
  const TaskResult refused = dispatcher->run(frame(), kStays);
  EXPECT_EQ(problemOf(refused), "busy");
  EXPECT_GE(refused.outcome.retryAfterSeconds, 3) << "what runs has taken more than a second already";
  leave = true;
  for (std::thread& each : held) each.join();
}

TEST_F(DispatcherTest, WhoFillsTheQueueTakesNoPlaceOfOthers) {
  const auto dispatcher = start(1, {.queueLimit = 4, .stopping = 200ms});
  std::atomic<bool> leave = false;
  std::vector<std::thread> threads = holdWorker(*dispatcher, frame("fault-loop"), leave);
  const auto ask = [&](const std::string& client) {
    Task task = frame();
    task.client = {client, client};
    return problemOf(dispatcher->run(task, kStays));
  };
  std::atomic<int> refused = 0;
  const auto wait = [&](const std::string& client) {
    const std::size_t before = dispatcher->state().waiting;
    threads.emplace_back([&, client] { refused += ask(client) == "busy" ? 1 : 0; });
    while (dispatcher->state().waiting == before) std::this_thread::sleep_for(1ms);
  };
  wait("greedy");
  wait("greedy");
  EXPECT_EQ(ask("greedy"), "busy") << "half of the queue is its share";
  wait("second");
  wait("third"); // it is full
  threads.emplace_back([&] { EXPECT_EQ(ask("modest"), ""); });
  while (refused == 0) std::this_thread::sleep_for(1ms); // one of greedy's gave way
  EXPECT_EQ(dispatcher->state().waiting, 4u);
  EXPECT_EQ(ask("greedy"), "busy");
  leave = true;
  for (std::thread& each : threads) each.join();
  EXPECT_EQ(refused, 1);
}

TEST_F(DispatcherTest, ClientsTakeTurns) {
  const auto dispatcher = start(1, {.stopping = 200ms});
  std::atomic<bool> leave = false;
  std::vector<std::thread> threads = holdWorker(*dispatcher, frame("fault-loop"), leave);
  std::atomic<int> greedyDone = 0, greedyBefore = -1;
  for (int i = 0; i < 20; ++i) {
    threads.emplace_back([&] {
      Task task = frame();
      task.client = {"greedy", "greedy"};
      dispatcher->run(task, kStays);
      ++greedyDone;
    });
  }
  while (dispatcher->state().waiting < 20) std::this_thread::sleep_for(1ms);
  threads.emplace_back([&] {
    Task task = frame();
    task.client = {"modest", "modest"};
    dispatcher->run(task, kStays);
    greedyBefore = greedyDone.load();
  });
  while (dispatcher->state().waiting < 21) std::this_thread::sleep_for(1ms);
  leave = true;
  for (std::thread& each : threads) each.join();
  EXPECT_LT(greedyBefore, 8) << "who came last, but has nothing in progress, does not wait for all of another's";
}

TEST_F(DispatcherTest, EndsInTime) {
  const auto dispatcher = start(1);
  std::thread asking([&] { EXPECT_EQ(problemOf(dispatcher->run(frame("fault-loop"), kStays)), "unavailable"); });
  while (dispatcher->state().running == 0) std::this_thread::sleep_for(1ms);
  dispatcher->endAt(Clock::now() + 100ms);
  asking.join();
}

} // namespace
} // namespace gnomon
