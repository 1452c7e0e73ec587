#include "server/redis/address.h"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace gnomon::redis {
namespace {

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

} // namespace
} // namespace gnomon::redis
