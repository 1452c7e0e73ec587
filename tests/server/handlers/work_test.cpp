#include "server/handlers/work.h"

#include <gtest/gtest.h>

namespace gnomon {
namespace {

using namespace std::chrono_literals;

TEST(ServerTiming, TellsTheStages) {
  EXPECT_EQ(serverTiming({{"queue", 0.1234}, {"load", 12}}), "queue;dur=0.123, load;dur=12.000");
  EXPECT_EQ(serverTiming({}), "");
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
