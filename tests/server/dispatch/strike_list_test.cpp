#include "server/dispatch/strike_list.h"

#include <gtest/gtest.h>
#include <string>

namespace gnomon {
namespace {

using namespace std::chrono_literals;

const Clock::time_point kStart = Clock::time_point() + 1h;

Task taskOf(const std::string& client, const std::string& request, const std::string& scene = "scene") {
  Task task;
  task.client = {client, client};
  task.request = request;
  task.order.scene = scene;
  return task;
}

const Problem kProblem{ProblemCode::internal, "", "Two workers ended over this request.", "", ""};

TEST(StrikeList, ARequestThatEndedTwoWorkersIsRefusedToEveryClientForAWhile) {
  StrikeList strikes;
  const Task task = taskOf("a", "{}");
  EXPECT_FALSE(strikes.refusalOf(task, kStart));
  strikes.addRequest(task, kProblem, kStart);
  for (const char* client : {"a", "b"}) {
    const auto refusal = strikes.refusalOf(taskOf(client, "{}"), kStart + 100s);
    ASSERT_TRUE(refusal) << client;
    EXPECT_EQ(refusal->problem.code, ProblemCode::internal);
    EXPECT_EQ(refusal->retryAfterSeconds, 200);
    EXPECT_EQ(refusal->problem.detail,
              "Two workers ended over this request. It is not tried again before 200 seconds have passed.");
    EXPECT_FALSE(refusal->isOfClient);
  }
  EXPECT_TRUE(strikes.refusalOf(task, kStart + 300s - 1ms));
  EXPECT_FALSE(strikes.refusalOf(task, kStart + 300s));
}

TEST(StrikeList, OtherRequestsScenesAndKindsAreTried) {
  StrikeList strikes;
  const Task task = taskOf("a", "{}");
  strikes.addRequest(task, kProblem, kStart);
  EXPECT_FALSE(strikes.refusalOf(taskOf("a", "{\"width\":1}"), kStart));
  EXPECT_FALSE(strikes.refusalOf(taskOf("a", "{}", "other"), kStart));
  Task plan = task;
  plan.order.kind = OrderKind::plan;
  EXPECT_FALSE(strikes.refusalOf(plan, kStart));
  Task again = task; // what each try has of its own
  again.order.number = 17;
  again.order.milliseconds = 3;
  EXPECT_TRUE(strikes.refusalOf(again, kStart));
}

TEST(StrikeList, AClientEndsAFewWorkersAMinute) {
  StrikeList strikes;
  const Task task = taskOf("a", "{}");
  for (std::size_t i = 0; i < StrikeList::kClientEnds; ++i) {
    EXPECT_FALSE(strikes.refusalOf(task, kStart + i * 10s)) << i;
    strikes.addEnd("a", kStart + i * 10s);
  }
  const auto refusal = strikes.refusalOf(task, kStart + 31s);
  ASSERT_TRUE(refusal);
  EXPECT_EQ(refusal->problem.code, ProblemCode::busy);
  EXPECT_EQ(refusal->retryAfterSeconds, 29);
  EXPECT_TRUE(refusal->isOfClient);
  EXPECT_FALSE(strikes.refusalOf(taskOf("b", "{}"), kStart + 31s));
  EXPECT_TRUE(strikes.refusalOf(task, kStart + 60s - 1ms));
  EXPECT_FALSE(strikes.refusalOf(task, kStart + 60s)) << "three ends of the last minute";
  strikes.addEnd("a", kStart + 61s);
  EXPECT_TRUE(strikes.refusalOf(task, kStart + 62s)) << "four again";
}

TEST(StrikeList, KeepsTheLastOnes) {
  StrikeList strikes;
  for (std::size_t i = 0; i <= StrikeList::kMost; ++i) {
    const std::string name = std::to_string(i);
    strikes.addRequest(taskOf("", name), kProblem, kStart);
    for (std::size_t end = 0; end < StrikeList::kClientEnds; ++end) strikes.addEnd(name, kStart);
  }
  const std::string last = std::to_string(StrikeList::kMost);
  EXPECT_FALSE(strikes.refusalOf(taskOf("x", "0"), kStart));
  EXPECT_TRUE(strikes.refusalOf(taskOf("x", "1"), kStart));
  EXPECT_TRUE(strikes.refusalOf(taskOf("x", last), kStart));
  EXPECT_FALSE(strikes.refusalOf("0", kStart));
  EXPECT_TRUE(strikes.refusalOf(last, kStart));
}

} // namespace
} // namespace gnomon
