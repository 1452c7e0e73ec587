#include "server/scenes/redis_backend.h"

#include <gtest/gtest.h>
#include <thread>

#include "server/scenes/stored_light_maps.h"
#include "server/scenes/upload.h"
#include "server/system/file_descriptor.h"
#include "tests/support/redis_server.h"

namespace gnomon {
namespace {

using namespace std::chrono_literals;
using testing::RedisServer;

PackedBundle bundleOf(int number, std::size_t bytes = 100) {
  return *packed({Bytes(bytes, static_cast<std::uint8_t>(number)), {}});
}

/// False where it does not come true in some seconds.
bool eventually(const std::function<bool()>& condition) {
  for (const auto end = Clock::now() + 20s; Clock::now() < end;) {
    if (condition()) return true;
    std::this_thread::sleep_for(5ms);
  }
  return false;
}

class RedisBackendTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!RedisServer::isInstalled()) GTEST_SKIP() << "redis-server is not installed.";
    server_ = std::make_unique<RedisServer>();
    redis_ = connect();
  }

  std::shared_ptr<redis::Redis> connect() const {
    return std::make_shared<redis::Redis>(redis::Options{.address = *redis::parseAddress(server_->url())});
  }

  std::unique_ptr<RedisBackend> open(RedisBackend::Options options = {}) const {
    options.memoryBytes = options.memoryBytes == 0 ? 64 << 20 : options.memoryBytes;
    options.memoryScenes = 100;
    return std::make_unique<RedisBackend>(connect(), options);
  }

  bool put(RedisBackend& scenes, const PackedBundle& bundle) const {
    const auto kept = scenes.put(bundle.id, bundle.file, bundle.bytes, "{}");
    return kept && *kept;
  }

  redis::Reply ask(const redis::Command& command) const {
    const auto reply = redis_->ask(command, {Clock::now() + 5s});
    return reply ? *reply : redis::Reply{.kind = redis::Reply::Kind::error, .text = "away"};
  }

  std::vector<std::string> keys() const {
    std::vector<std::string> keys;
    for (const redis::Reply& key : ask({"KEYS", "*"}).elements) keys.push_back(key.text);
    return keys;
  }

  std::unique_ptr<RedisServer> server_;
  std::shared_ptr<redis::Redis> redis_;
};

TEST_F(RedisBackendTest, WhatIsInMemoryIsServedWhileRedisIsAway) {
  const auto scenes = open();
  const PackedBundle kept = bundleOf(1);
  const PackedBundle other = bundleOf(2);
  ASSERT_TRUE(put(*scenes, kept));
  ASSERT_TRUE(put(*open(), other));
  server_->kill();
  EXPECT_TRUE(scenes->use(kept.id));
  EXPECT_TRUE(scenes->bundle(kept.id));
  EXPECT_TRUE(scenes->summary(kept.id));
  EXPECT_EQ(scenes->use(other.id).problems().front().code, ProblemCode::unavailable);
  EXPECT_EQ(scenes->bundle(other.id).problems().front().code, ProblemCode::unavailable);
  EXPECT_EQ(scenes->remove(kept.id).problems().front().code, ProblemCode::unavailable);
  const PackedBundle third = bundleOf(3);
  EXPECT_EQ(scenes->put(third.id, third.file, 100, "{}").problems().front().code, ProblemCode::unavailable);
  EXPECT_FALSE(scenes->state().isReachable);
  server_->start();
  EXPECT_TRUE(eventually([&] { return static_cast<bool>(scenes->bundle(other.id)); })) << "it finds it by itself";
  EXPECT_TRUE(put(*scenes, third));
  EXPECT_TRUE(scenes->state().isReachable);
}

TEST_F(RedisBackendTest, AWarmSceneNeedsNoCall) {
  const auto scenes = open();
  ASSERT_TRUE(put(*scenes, bundleOf(1)));
  const auto before = scenes->state().calls;
  for (int i = 0; i < 100; ++i) {
    EXPECT_TRUE(scenes->use(bundleOf(1).id));
    EXPECT_TRUE(scenes->bundle(bundleOf(1).id));
  }
  EXPECT_LE(scenes->state().calls, before + 1) << "one may be that of the subscription's beginning";
  EXPECT_EQ(scenes->state().hits, 100u);
  EXPECT_EQ(scenes->state().misses, 0u);
}

TEST_F(RedisBackendTest, ARemovalThatNobodyToldIsFoundAfterTheReturn) {
  const auto scenes = open();
  const PackedBundle bundle = bundleOf(1);
  ASSERT_TRUE(put(*scenes, bundle));
  server_->kill();
  ASSERT_TRUE(eventually([&] { return !scenes->state().isReachable; }));
  server_->start();
  for (const std::string& key : keys()) ask({"DEL", key}); // as another server that was back before
  EXPECT_TRUE(eventually([&] {
    const auto used = scenes->use(bundle.id);
    return !used && used.problems().front().code == ProblemCode::notFound;
  }));
}

TEST_F(RedisBackendTest, NothingIsLeftOfAnUploadThatHadNoRoom) {
  const auto scenes = open({.quotaBytes = 100});
  ASSERT_TRUE(put(*scenes, bundleOf(1, 60)));
  const auto before = keys().size();
  EXPECT_FALSE(put(*scenes, bundleOf(2, 60)));
  EXPECT_EQ(keys().size(), before);
}

TEST_F(RedisBackendTest, AFullRedisIsSaidToBeFullAndKeepsNothing) {
  const auto scenes = open();
  ask({"CONFIG", "SET", "maxmemory-policy", "noeviction"});
  ask({"CONFIG", "SET", "maxmemory", "12mb"});
  const PackedBundle large = bundleOf(1, 30 << 20);
  const auto refused = scenes->put(large.id, large.file, large.bytes, "{}");
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.problems().front().code, ProblemCode::insufficientStorage);
  EXPECT_TRUE(eventually([&] { return keys().empty(); }));
  ask({"CONFIG", "SET", "maxmemory", "0"});
  EXPECT_TRUE(put(*scenes, bundleOf(2)));
}

TEST_F(RedisBackendTest, WhatAnUploadLeftThatDiedExpires) {
  const RedisParts parts = newParts(100);
  const auto file = memoryFile(Bytes(100, 7));
  ASSERT_TRUE(writeParts(*redis_, parts, *file, kForScene));
  const auto left = keys();
  ASSERT_EQ(left.size(), 1u);
  const auto expires = ask({"TTL", left.front()}).integer;
  EXPECT_GT(expires, 0);
  EXPECT_LE(expires, 600);
  const auto scenes = open({.quotaBytes = 150});
  ask({"ZADD", "gnomon:writing", "1", parts.token + ":100"}); // and takes no room any more
  EXPECT_TRUE(put(*scenes, bundleOf(1)));
  EXPECT_EQ(ask({"ZCARD", "gnomon:writing"}).integer, 0);
}

TEST_F(RedisBackendTest, DamagedBytesAreRemovedAndMayComeAgain) {
  const PackedBundle bundle = bundleOf(1);
  ASSERT_TRUE(put(*open(), bundle));
  for (const std::string& key : keys()) {
    if (key.starts_with("gnomon:part:")) ask({"SETRANGE", key, "5", "x"});
  }
  const auto scenes = open();
  EXPECT_EQ(scenes->bundle(bundle.id).problems().front().code, ProblemCode::notFound);
  EXPECT_FALSE(scenes->contains(bundle.id));
  EXPECT_TRUE(put(*scenes, bundle));
  EXPECT_TRUE(open()->bundle(bundle.id));
}

TEST_F(RedisBackendTest, WhatIsNonsenseThereIsRefusedOrNone) {
  const auto scenes = open();
  const std::string id = bundleOf(1).id;
  for (const char* bytes : {"99999999999999999999", "18446744073709551615", "-1", "x", "0"}) {
    ask({"DEL", "gnomon:scene:" + id});
    ask({"HSET", "gnomon:scene:" + id, "parts", "p", "bytes", bytes, "count", "1"});
    EXPECT_FALSE(scenes->bundle(id)) << bytes;
  }
  ask({"DEL", "gnomon:scene:" + id});
  ask({"SET", "gnomon:scene:" + id, "text"});
  EXPECT_EQ(scenes->bundle(id).problems().front().code, ProblemCode::unavailable);
}

TEST_F(RedisBackendTest, WhatNobodyUsesGoesEverywhere) {
  const auto scenes = open({.age = 2s});
  const auto other = open({.age = 2s});
  std::vector<std::string> removed;
  ASSERT_TRUE(put(*scenes, bundleOf(1)));
  ASSERT_TRUE(put(*scenes, bundleOf(2)));
  const auto end = Clock::now() + 20s;
  while (removed.empty() && Clock::now() < end) {
    EXPECT_TRUE(other->use(bundleOf(2).id)) << "which the other has in memory after the first time";
    EXPECT_TRUE(other->bundle(bundleOf(2).id));
    other->keepClean([&](const std::string& id) { removed.push_back(id); });
    scenes->keepClean([&](const std::string& id) { removed.push_back(id); });
    std::this_thread::sleep_for(50ms);
  }
  EXPECT_EQ(removed, std::vector{bundleOf(1).id});
  EXPECT_FALSE(scenes->use(bundleOf(1).id));
  EXPECT_TRUE(scenes->use(bundleOf(2).id));
  EXPECT_EQ(scenes->size().bytes, 100u);
}

TEST_F(RedisBackendTest, ScenesThatAreOldAllAtOnceStayForATenthOfTheirAgeMore) {
  const auto scenes = open({.age = 4s});
  std::vector<std::string> removed;
  const auto pass = [&] { scenes->keepClean([&](const std::string& id) { removed.push_back(id); }); };
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(put(*scenes, bundleOf(i)));
  for (int i = 0; i < 3; ++i) ask({"ZADD", "gnomon:used", "1", bundleOf(i).id}); // as when Redis' clock is set forward
  pass();
  EXPECT_TRUE(removed.empty());
  std::this_thread::sleep_for(400ms);
  pass();
  EXPECT_EQ(removed.size(), 3u);
}

TEST_F(RedisBackendTest, ASceneThatIsInNoMemoryIsReadOnceByMany) {
  const PackedBundle bundle = bundleOf(1, 6'000'000);
  ASSERT_TRUE(put(*open(), bundle));
  const auto scenes = open();
  std::vector<std::thread> threads;
  for (int i = 0; i < 8; ++i) {
    threads.emplace_back([&] { EXPECT_TRUE(scenes->bundle(bundle.id)); });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(scenes->state().misses, 1u);
}

TEST_F(RedisBackendTest, MemoryIsBounded) {
  const auto scenes = open({.memoryBytes = 3'000'000});
  for (int i = 0; i < 6; ++i) ASSERT_TRUE(put(*scenes, bundleOf(i, 1'000'000)));
  EXPECT_LE(scenes->state().inMemory.bytes, 3'000'000u);
  EXPECT_EQ(scenes->size().scenes, 6u);
  for (int i = 0; i < 6; ++i) EXPECT_TRUE(scenes->bundle(bundleOf(i, 1'000'000).id));
  EXPECT_LE(scenes->state().inMemory.bytes, 3'000'000u);
  const PackedBundle large = bundleOf(7, 3'000'001);
  EXPECT_EQ(scenes->put(large.id, large.file, large.bytes, "{}").problems().front().code, ProblemCode::tooLarge);
}

class RedisLightMapsTest : public RedisBackendTest {
 protected:
  static std::string key(int scene, int map) {
    return std::string(64, static_cast<char>('a' + scene)) + "-" + std::string(64, static_cast<char>('0' + map));
  }
  static void write(StoredLightMaps& maps, const std::string& key, const Bytes& bytes) {
    maps.write(key, *memoryFile(bytes));
  }
  static std::optional<Bytes> read(StoredLightMaps& maps, const std::string& key) {
    const FileDescriptor file = maps.open(key);
    return file ? readFile(file, 100 << 20) : std::nullopt;
  }
};

TEST_F(RedisLightMapsTest, AreKeptForAllServers) {
  RedisLightMaps one(connect(), 20 << 20);
  RedisLightMaps other(connect(), 20 << 20);
  const Bytes large(5'000'000, 9);
  write(one, key(0, 1), large);
  write(one, key(0, 1), large);
  EXPECT_EQ(read(other, key(0, 1)), large);
  EXPECT_FALSE(read(other, key(0, 2)));
  EXPECT_FALSE(read(other, "../" + key(0, 1)));
  EXPECT_EQ(ask({"GET", "gnomon:maps:bytes"}).text, "5000000");
}

TEST_F(RedisLightMapsTest, TheLeastUsedGoFirst) {
  RedisLightMaps maps(connect(), 250);
  const auto next = [] { std::this_thread::sleep_for(3ms); }; // Redis tells times in milliseconds
  write(maps, key(0, 1), Bytes(100, 1));
  next();
  write(maps, key(0, 2), Bytes(100, 2));
  next();
  EXPECT_TRUE(read(maps, key(0, 1)));
  next();
  write(maps, key(0, 3), Bytes(100, 3));
  EXPECT_TRUE(read(maps, key(0, 1)));
  EXPECT_FALSE(read(maps, key(0, 2)));
  EXPECT_TRUE(read(maps, key(0, 3)));
  write(maps, key(0, 4), Bytes(251, 4));
  EXPECT_FALSE(read(maps, key(0, 4)));
}

TEST_F(RedisLightMapsTest, GoWithTheirScene) {
  RedisLightMaps maps(connect(), 1 << 20);
  write(maps, key(0, 1), Bytes(100, 1));
  write(maps, key(1, 1), Bytes(100, 2));
  maps.removeScene(key(0, 1).substr(0, 64));
  EXPECT_FALSE(read(maps, key(0, 1)));
  EXPECT_TRUE(read(maps, key(1, 1)));
  EXPECT_EQ(ask({"GET", "gnomon:maps:bytes"}).text, "100");
}

} // namespace
} // namespace gnomon
