#include "server/redis/reply.h"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "server/redis/address.h"
#include "server/redis/redis.h"

namespace gnomon::redis {
namespace {

using std::chrono::milliseconds;

std::string wire(const Reply& reply) {
  const std::string size = std::to_string(reply.text.size());
  switch (reply.kind) {
    case Reply::Kind::nil:
      return "$-1\r\n";
    case Reply::Kind::integer:
      return ":" + std::to_string(reply.integer) + "\r\n";
    case Reply::Kind::text:
      return "$" + size + "\r\n" + reply.text + "\r\n";
    case Reply::Kind::error:
      return "-" + reply.text + "\r\n";
    case Reply::Kind::array:
      break;
  }
  std::string text = "*" + std::to_string(reply.elements.size()) + "\r\n";
  for (const Reply& element : reply.elements) text += wire(element);
  return text;
}

Reply textOf(std::string bytes) {
  return {.kind = Reply::Kind::text, .text = std::move(bytes)};
}

/// Any reply, with arrays in arrays up to a depth.
Reply anyReply(int depth) {
  switch (*rc::gen::inRange(0, depth > 0 ? 5 : 4)) {
    case 0:
      return {};
    case 1:
      return {.kind = Reply::Kind::integer, .integer = *rc::gen::arbitrary<std::int64_t>()};
    case 2:
      return textOf(*rc::gen::arbitrary<std::string>());
    case 3:
      return {.kind = Reply::Kind::error, .text = "ERR " + std::to_string(*rc::gen::inRange(0, 100))};
    default:
      break;
  }
  Reply array{.kind = Reply::Kind::array};
  const int count = *rc::gen::inRange(0, 4);
  for (int i = 0; i < count; ++i) array.elements.push_back(anyReply(depth - 1));
  return array;
}

/// All replies in these bytes, fed in pieces of so many.
std::vector<Reply> readIn(std::string_view bytes, std::size_t piece) {
  ReplyReader reader;
  reader.allow({});
  std::vector<Reply> replies;
  while (!bytes.empty()) {
    EXPECT_TRUE(reader.feed(bytes.substr(0, piece)));
    bytes.remove_prefix(std::min(piece, bytes.size()));
    while (auto reply = reader.next()) replies.push_back(*std::move(reply));
  }
  EXPECT_TRUE(reader.isEmpty());
  return replies;
}

RC_GTEST_PROP(RedisReply, IsTheSameInAnyPieces, ()) {
  std::string bytes;
  const int count = *rc::gen::inRange(1, 4);
  for (int i = 0; i < count; ++i) bytes += wire(anyReply(4));
  const auto replies = readIn(bytes, static_cast<std::size_t>(*rc::gen::inRange(1, 20)));
  std::string again;
  for (const Reply& reply : replies) again += wire(reply);
  RC_ASSERT(again == bytes);
}

RC_GTEST_PROP(RedisReply, AnyBytesAreReadOrRefused, (const std::string& bytes)) {
  ReplyReader reader;
  reader.allow({.bytes = 1'000, .elements = 10});
  reader.feed(std::string(1, "$*:+-"[bytes.size() % 5]) + bytes);
  while (reader.next()) {
  }
}

TEST(RedisReply, ReadsAStatusAsText) {
  const auto replies = readIn("+OK\r\n-WRONGTYPE no\r\n*-1\r\n", 1);
  ASSERT_EQ(replies.size(), 3u);
  EXPECT_EQ(replies[0].text, "OK");
  EXPECT_TRUE(replies[1].isError("WRONGTYPE"));
  EXPECT_FALSE(replies[1].isError("ERR"));
  EXPECT_TRUE(replies[2].isNil());
}

TEST(RedisReply, TakesNoMoreThanItsLimits) {
  const auto reads = [](const std::string& bytes) {
    ReplyReader reader;
    reader.allow({.bytes = 64, .elements = 4});
    return reader.feed(bytes) && reader.next() && !reader.isBroken();
  };
  EXPECT_TRUE(reads(wire(textOf(std::string(50, 'x')))));
  EXPECT_FALSE(reads(wire(textOf(std::string(60, 'x')))));
  EXPECT_TRUE(reads("*4\r\n:1\r\n:2\r\n:3\r\n:4\r\n"));
  EXPECT_FALSE(reads("*5\r\n:1\r\n:2\r\n:3\r\n:4\r\n:5\r\n"));
  EXPECT_FALSE(reads("*2\r\n*2\r\n:1\r\n:2\r\n*1\r\n:3\r\n")) << "arrays in arrays count together";
}

TEST(RedisReply, AllocatesNothingForWhatIsOnlyAnnounced) {
  for (const char* bytes : {"*2147483647\r\n", "*99999999999999999999\r\n", "*-5\r\n", "?\r\n"}) {
    ReplyReader reader;
    reader.allow({});
    reader.feed(bytes);
    EXPECT_FALSE(reader.next());
    EXPECT_TRUE(reader.isBroken()) << bytes;
    EXPECT_FALSE(reader.feed("+OK\r\n")) << "nothing can be read any more";
  }
  ReplyReader reader;
  reader.allow({});
  EXPECT_TRUE(reader.feed("$1000000000\r\nabc"));
  EXPECT_FALSE(reader.next()) << "it waits for the rest, which the limit ends";
  EXPECT_FALSE(reader.feed(std::string(1 << 20, 'x')));
}

TEST(RedisReply, CommandsAreBytesOfAnyKind) {
  EXPECT_EQ(wireText({"SET", std::string("k\0\r\n", 4), ""}),
            std::string("*3\r\n$3\r\nSET\r\n$4\r\nk\0\r\n\r\n$0\r\n\r\n", 29));
}

TEST(RedisScript, IsNamedByTheDigestOfItsText) {
  EXPECT_EQ(Script("abc").sha1(), "a9993e364706816aba3e25717850c26c9cd0d89d"); // FIPS 180-2, A.1
  EXPECT_EQ(Script("").sha1(), "da39a3ee5e6b4b0d3255bfef95601890afd80709");
}

TEST(RedisAddress, ReadsEveryPart) {
  const auto address = parseAddress("rediss://some%40one:p%3A%2F%40ss@cache.example:6400/3");
  ASSERT_TRUE(address);
  EXPECT_EQ(address->user, "some@one");
  EXPECT_EQ(address->password, "p:/@ss");
  EXPECT_EQ(address->host, "cache.example");
  EXPECT_EQ(address->port, 6400);
  EXPECT_EQ(address->database, 3);
  EXPECT_TRUE(address->isEncrypted);
}

TEST(RedisAddress, KnowsWhatIsLeftOut) {
  const auto address = parseAddress("redis://host");
  ASSERT_TRUE(address);
  EXPECT_EQ(address->port, 6379);
  EXPECT_EQ(address->database, 0);
  EXPECT_TRUE(address->user.empty());
  EXPECT_FALSE(address->isEncrypted);
  EXPECT_EQ(parseAddress("redis://:secret@host/")->password, "secret");
  EXPECT_EQ(parseAddress("redis://secret@host")->password, "secret");
  EXPECT_EQ(parseAddress("redis://[::1]:7000")->host, "::1");
  EXPECT_EQ(parseAddress("redis://[::1]")->port, 6379);
}

TEST(RedisAddress, RefusesWhatItCannotRead) {
  for (const char* text :
       {"", "redis", "redis:", "redis:/host", "http://host", "redis://", "redis://:6379", "redis://host:0",
        "redis://host:65536", "redis://host:x", "redis://host/x", "redis://host/-1", "redis://host/1/2",
        "redis://ho st", "redis://::1", "redis://[::1", "redis://[host]", "redis://[::1]x", "redis://%zz@host"}) {
    EXPECT_FALSE(parseAddress(text)) << text;
  }
}

TEST(RedisAddress, IsShownWithoutItsPassword) {
  const auto address = parseAddress("redis://user:secret@[::1]:7000/2");
  ASSERT_TRUE(address);
  EXPECT_EQ(shownText(*address), "redis://[::1]:7000/2");
  const auto refused = parseAddress("redis://user:secret@host:99999");
  ASSERT_FALSE(refused);
  const Problem& problem = refused.problems().front();
  EXPECT_EQ((problem.detail + problem.actual + problem.limit).find("secret"), std::string::npos);
}

RC_GTEST_PROP(RedisAddress, AnyTextIsReadOrRefused, (const std::string& text)) {
  const auto read = parseAddress("redis://" + text);
  if (read) RC_ASSERT(parseAddress(shownText(*read)));
}

TEST(RedisAddress, TakesItsPasswordFromAFile) {
  const auto file = std::filesystem::temp_directory_path() / "gnomon-redis-password";
  std::ofstream(file) << "secret word\nsecond line";
  EXPECT_EQ(*passwordFrom(file), "secret word");
  std::ofstream(file, std::ios::trunc) << "\n";
  EXPECT_FALSE(passwordFrom(file));
  std::ofstream(file, std::ios::trunc) << std::string(4'097, 'x');
  EXPECT_FALSE(passwordFrom(file));
  std::filesystem::remove(file);
  EXPECT_FALSE(passwordFrom(file));
}

TEST(Backoff, DoublesUpToItsLongest) {
  EXPECT_EQ(backoffDelay(1, 1), milliseconds(50));
  EXPECT_EQ(backoffDelay(2, 1), milliseconds(100));
  EXPECT_EQ(backoffDelay(7, 1), milliseconds(3'200));
  EXPECT_EQ(backoffDelay(8, 1), milliseconds(5'000));
  EXPECT_EQ(backoffDelay(1'000'000, 1), milliseconds(5'000));
}

TEST(Backoff, IsBetweenHalfAndAllByChance) {
  EXPECT_EQ(backoffDelay(3, 0), milliseconds(100));
  EXPECT_EQ(backoffDelay(3, 0.5), milliseconds(150));
  EXPECT_EQ(backoffDelay(3, 1), milliseconds(200));
}

} // namespace
} // namespace gnomon::redis
