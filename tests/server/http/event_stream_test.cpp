#include "server/http/event_stream.h"

#include <atomic>
#include <gtest/gtest.h>
#include <string>
#include <thread>

namespace gnomon {
namespace {

using namespace std::chrono_literals;

TEST(EventStream, AnEventIsItsNameItsDataAndAnEmptyLine) {
  EXPECT_EQ(eventText("row", "{\"a\":1}"), "event: row\ndata: {\"a\":1}\n\n");
}

TEST(EventStream, SendsEverythingInOrderAndEnds) {
  EventStream events;
  std::string sent;
  std::thread putting([&] {
    for (int i = 0; i < 100; ++i) events.put("n", std::to_string(i));
    events.end();
  });
  EXPECT_TRUE(events.sendTo(
      [&](std::string_view bytes) {
        sent += bytes;
        return true;
      },
      1h));
  putting.join();
  std::string all;
  for (int i = 0; i < 100; ++i) all += eventText("n", std::to_string(i));
  EXPECT_EQ(sent, all);
}

TEST(EventStream, SaysThatItLivesWhileNothingComes) {
  EventStream events;
  std::atomic<int> comments = 0;
  std::thread ending([&] {
    while (comments < 3) std::this_thread::sleep_for(1ms);
    events.end();
  });
  EXPECT_TRUE(events.sendTo(
      [&](std::string_view bytes) {
        EXPECT_EQ(bytes, ":\n\n");
        ++comments;
        return true;
      },
      1ms));
  ending.join();
}

TEST(EventStream, StopsWhereTheClientIsGone) {
  EventStream events;
  events.put("a", "1");
  EXPECT_FALSE(events.sendTo([](std::string_view) { return false; }, 1h));
  EventStream silent;
  EXPECT_FALSE(silent.sendTo([](std::string_view) { return false; }, 1ms)) << "a comment finds out, too";
}

/// A client that reads nothing until everything is put.
std::string readAtLast(EventStream& events) {
  events.end();
  std::string sent;
  EXPECT_TRUE(events.sendTo(
      [&](std::string_view bytes) {
        sent += bytes;
        return true;
      },
      1h));
  return sent;
}

TEST(EventStream, WhoReadsSlowlyGetsTheNewestProgress) {
  constexpr int kMost = EventStream::kMostEvents;
  EventStream events;
  std::string expected;
  for (int i = 0; i < 1000; ++i) {
    events.put("progress", std::to_string(i));
    if (i < kMost - 1) expected += eventText("progress", std::to_string(i));
  }
  expected += eventText("progress", "999");
  for (const char* name : {"row", "row", "progress", "result"}) {
    events.put(name, "{}");
    expected += eventText(name, "{}");
  }
  EXPECT_EQ(readAtLast(events), expected) << "nothing but progress is left out";
}

TEST(EventStream, WhoReadsNothingIsGivenUp) {
  const std::string row(1 << 20, 'x');
  EventStream events;
  for (std::size_t i = 0; i < EventStream::kMostBytes / row.size(); ++i) events.put("row", row);
  events.put("row", row);
  int sent = 0;
  EXPECT_FALSE(events.sendTo([&](std::string_view) { return ++sent > 0; }, 1h));
  EXPECT_EQ(sent, 0);
}

TEST(EventStream, OneEventMayBeLarger) {
  const std::string result(EventStream::kMostBytes + 1, 'x');
  EventStream events;
  events.put("result", result);
  EXPECT_EQ(readAtLast(events), eventText("result", result));
}

} // namespace
} // namespace gnomon
