#include <atomic>
#include <gtest/gtest.h>
#include <string>
#include <thread>

#include "protocol/base/bytes.h"
#include "server/handlers/event_reply.h"
#include "server/handlers/sequence_forms.h"

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

std::uint64_t numberAt(std::string_view text, std::size_t at, int bytes) {
  std::uint64_t value = 0;
  for (int i = bytes; i-- > 0;) value = value << 8 | static_cast<std::uint8_t>(text[at + static_cast<std::size_t>(i)]);
  return value;
}

TEST(ZipStream, TheEndPointsAtTheDirectoryAndThatAtTheFiles) {
  ZipStream zip;
  const std::string first = zip.head("a.txt", 3, crc32Of(asBytes("one"))) + "one";
  const std::string second = zip.head("b.txt", 4, crc32Of(asBytes("two!"))) + "two!";
  const std::string tail = zip.end();
  const std::string all = first + second + tail;
  const std::size_t end = all.size() - 22;
  EXPECT_EQ(numberAt(all, end, 4), 0x06054b50u);
  EXPECT_EQ(numberAt(all, end + 10, 2), 2u);
  const std::size_t directory = numberAt(all, end + 16, 4);
  EXPECT_EQ(directory, first.size() + second.size());
  EXPECT_EQ(numberAt(all, directory, 4), 0x02014b50u);
  const std::size_t next = directory + 46 + 5;
  EXPECT_EQ(numberAt(all, next + 42, 4), first.size());
  EXPECT_EQ(all.substr(next + 46, 5), "b.txt");
}

TEST(ZipStream, MoreFilesThanSixteenBitsCountAreZip64) {
  ZipStream zip;
  for (int i = 0; i < 70'000; ++i) zip.head("f", 0, 0);
  const std::string tail = zip.end();
  const std::size_t end = tail.size() - 22;
  EXPECT_EQ(numberAt(tail, end + 10, 2), 0xffffu);
  const std::size_t locator = end - 20;
  EXPECT_EQ(numberAt(tail, locator, 4), 0x07064b50u);
  const std::size_t record = locator - 56;
  EXPECT_EQ(numberAt(tail, record, 4), 0x06064b50u);
  EXPECT_EQ(numberAt(tail, record + 32, 8), 70'000u);
}

TEST(ZipStream, AFileBehindFourGigabytesHasALongOffset) {
  ZipStream zip;
  for (int i = 0; i < 65; ++i) zip.head("p", 64u << 20, 0);
  const std::string tail = zip.end();
  const std::size_t last = 64 * 47; // 46 bytes and a name of one; the first 64 files begin below 4 GB
  EXPECT_EQ(numberAt(tail, last, 4), 0x02014b50u);
  EXPECT_EQ(numberAt(tail, last + 42, 4), 0xffffffffu);
  EXPECT_EQ(numberAt(tail, last + 47, 2), 1u);
  EXPECT_EQ(numberAt(tail, last + 51, 8), 64u * (30 + 1 + (64ull << 20)));
}

} // namespace
} // namespace gnomon
