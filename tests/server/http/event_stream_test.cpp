#include "server/http/event_stream.h"

#include <atomic>
#include <gtest/gtest.h>
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

} // namespace
} // namespace gnomon
