#include "server/handlers/work.h"

#include <algorithm>
#include <gtest/gtest.h>

#include "server/system/shared_bytes.h"

namespace gnomon {
namespace {

using namespace std::chrono_literals;

const std::function<bool()> kWanted = [] { return false; };

TaskResult resultOf(SharedBytes body) {
  TaskResult result;
  result.outcome.contentType = "image/png";
  result.body = std::move(body);
  return result;
}

/// Nothing of what a worker sent, but its size.
SharedBytes unread(std::size_t bytes) {
  return {nullptr, {static_cast<const char*>(nullptr), bytes}};
}

TEST(ServerTiming, NoTimeIsReadBeyondItsText) {
  const std::string text = serverTiming({{"queue", 1e308}, {"load", 1}});
  EXPECT_EQ(text.find('\0'), std::string::npos);
  EXPECT_LT(text.size(), 80u);
}

TEST(ServerTiming, TellsTheStages) {
  EXPECT_EQ(serverTiming({{"queue", 0.1234}, {"load", 12}}), "queue;dur=0.123, load;dur=12.000");
  EXPECT_EQ(serverTiming({}), "");
}

TEST(WarningsField, IsJsonInAsciiOfALengthThatProxiesPass) {
  EXPECT_EQ(warningsField({"Too \"coarse\"", "caf\u00e9\r\nX: y"}), R"(["Too \"coarse\"","caf\u00e9\r\nX: y"])");
  const std::string many = warningsField(std::vector<std::string>(100, std::string(200, 'w')));
  EXPECT_LT(many.size(), kMostWarningBytes + 100);
  EXPECT_NE(many.find(" more warnings are in the frame's report.\"]"), std::string::npos) << many;
}

TEST(ReplyOf, APictureCarriesItsWarnings) {
  TaskResult result = resultOf("file");
  result.outcome.warnings = {"The picture shows nothing."};
  const HttpReply reply = replyOf(std::move(result), "id");
  const std::pair<std::string, std::string> wanted{"Gnomon-Warnings", R"(["The picture shows nothing."])"};
  EXPECT_NE(std::find(reply.headers.begin(), reply.headers.end(), wanted), reply.headers.end());
}

TEST(TaskFor, EndsWhenTheServerOrTheClientSays) {
  RouteCall call;
  const auto allowed = [&](const char* prefer) {
    call.request.headers = {{"prefer", prefer}};
    const Task task = taskFor(call, OrderKind::frame, "id", {}, "{}", 60s);
    EXPECT_EQ(task.deadline - call.request.arrived, task.allowed);
    return task.allowed;
  };
  EXPECT_EQ(allowed(""), 60s);
  EXPECT_EQ(allowed("wait=5"), 5s);
  EXPECT_EQ(allowed("respond-async, wait=5"), 5s);
  EXPECT_EQ(allowed("wait=600"), 60s) << "no longer than the server allows";
  for (const char* none : {"wait=0", "wait=-1", "wait=x", "wait=5x", "waiting=5", "wait="})
    EXPECT_EQ(allowed(none), 60s);
}

TEST(ReplyRoom, IsTakenBeforeAnythingIsRead) {
  constexpr std::size_t kTooMuchToRead = std::size_t{1} << 40;
  ByteBudget budget(1 << 20);
  ByteLease others(budget);
  ASSERT_TRUE(others.grow(1));
  TaskResult result = resultOf(unread(kTooMuchToRead));
  const auto begun = Clock::now();
  takeRoom(result, budget, {}, begun + 20ms, kWanted);
  EXPECT_GE(Clock::now() - begun, 20ms) << "it waits for others to be taken";
  EXPECT_FALSE(result.body) << "its memory is given back";
  EXPECT_EQ(result.refusal, TaskRefusal::memory);
  const HttpReply reply = replyOf(std::move(result), "id");
  EXPECT_EQ(reply.status, 503);
  EXPECT_EQ(reply.refusal, RefusalReason::memory);
  EXPECT_EQ(budget.used(), 1u);
}

TEST(ReplyRoom, IsHeldUntilTheReplyGoes) {
  ByteBudget budget(3 << 20);
  const Bytes picture(1 << 20, 'x');
  TaskResult result = resultOf(picture);
  takeRoom(result, budget, {}, Clock::now(), kWanted);
  EXPECT_EQ(budget.used(), picture.size());
  {
    const HttpReply reply = replyOf(std::move(result), "id");
    EXPECT_EQ(reply.status, 200);
    EXPECT_EQ(reply.body, asText(picture));
    EXPECT_EQ(budget.used(), picture.size());
    HttpReply copy = reply;
    EXPECT_EQ(copy.room.held(), 0u) << "its bytes are others, for which its own room is taken";
  }
  EXPECT_EQ(budget.used(), 0u);
}

TEST(ReplyRoom, IsNotNeededByWhatIsSmall) {
  ByteBudget budget(1 << 20);
  ByteLease others(budget);
  ASSERT_TRUE(others.grow(budget.total()));
  TaskResult result = resultOf(Bytes(1000, 'x'));
  takeRoom(result, budget, {}, Clock::now(), kWanted);
  EXPECT_EQ(replyOf(std::move(result), "id").status, 200);
}

TEST(ReplyRoom, OneReplyMayBeLargerThanAllOfIt) {
  ByteBudget budget(1 << 17);
  TaskResult result = resultOf(Bytes(1 << 20, 'x'));
  takeRoom(result, budget, {}, Clock::now(), kWanted);
  EXPECT_EQ(result.room.held(), budget.total());
}

TEST(ReplyRoom, IsNotWaitedForOnceNobodyWantsIt) {
  ByteBudget budget(1 << 20);
  ByteLease others(budget);
  ASSERT_TRUE(others.grow(budget.total()));
  TaskResult result = resultOf(unread(1 << 20));
  takeRoom(result, budget, {}, Clock::now() + 1h, [] { return true; });
  EXPECT_FALSE(result.body);
}

TEST(Prefer, AsksForAJobByItsToken) {
  HttpRequest request;
  const auto prefers = [&](const char* prefer) {
    request.headers = {{"prefer", prefer}};
    return prefersAsync(request);
  };
  for (const char* token : {"respond-async", "wait=5, respond-async", "Respond-Async,wait=5"})
    EXPECT_TRUE(prefers(token));
  for (const char* other : {"", "wait=5", "respond-asynchronously", "respond-async=no", "no-respond-async"}) {
    EXPECT_FALSE(prefers(other)) << other;
  }
  request.headers.clear();
  EXPECT_FALSE(prefersAsync(request));
}

TEST(TaskFor, TellsTheWorkerWhichTraceItBelongsTo) {
  RouteCall call;
  call.request.trace.traceId = "0af7651916cd43dd8448eb211c80319c";
  EXPECT_EQ(taskFor(call, OrderKind::frame, "id", {}, "{}", 60s).order.traceId, call.request.trace.traceId);
}

TEST(Permits, AreGivenBack) {
  std::counting_semaphore<> permits(1);
  Permit first = permitOf(permits);
  EXPECT_TRUE(first);
  EXPECT_FALSE(permitOf(permits));
  Permit copy = first;
  first.reset();
  EXPECT_FALSE(permitOf(permits)) << "a copy still holds it";
  copy.reset();
  EXPECT_TRUE(permitOf(permits));
}

} // namespace
} // namespace gnomon
