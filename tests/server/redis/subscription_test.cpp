#include "server/redis/subscription.h"

#include <condition_variable>
#include <csignal>
#include <gtest/gtest.h>
#include <mutex>

#include "server/redis/redis.h"
#include "server/redis/stream.h"
#include "tests/support/redis_server.h"

namespace gnomon::redis {
namespace {

using namespace std::chrono_literals;
using testing::RedisServer;

/// What a subscription told, for a test to wait for.
class Heard {
 public:
  Subscription::Listener listener() {
    return {[this] { add(begun_); }, [this](const std::string& message) { add(told_, message); }};
  }

  bool hasBegun(std::size_t times) { return wait(begun_, times); }
  bool hasTold(std::size_t messages) { return wait(told_, messages); }
  std::string last() {
    const std::lock_guard lock(mutex_);
    return told_.back();
  }

 private:
  void add(std::vector<std::string>& list, const std::string& message = "") {
    const std::lock_guard lock(mutex_);
    list.push_back(message);
    changed_.notify_all();
  }
  bool wait(const std::vector<std::string>& list, std::size_t count) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, 20s, [&] { return list.size() >= count; });
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<std::string> begun_;
  std::vector<std::string> told_;
};

class SubscriptionTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!RedisServer::isInstalled()) GTEST_SKIP() << "redis-server is not installed.";
    server_ = std::make_unique<RedisServer>();
    redis_ = std::make_unique<Redis>(Options{.address = *parseAddress(server_->url())});
  }

  bool publish(const std::string& message) {
    const auto reached = redis_->ask({"PUBLISH", "news", message}, {Clock::now() + 5s});
    return reached && reached->integer == 1;
  }

  std::unique_ptr<RedisServer> server_;
  std::unique_ptr<Redis> redis_;
  Heard heard_;
};

TEST_F(SubscriptionTest, HearsMessagesAlsoAfterQuietSeconds) {
  const Subscription subscription(*redis_, "news", heard_.listener());
  ASSERT_TRUE(heard_.hasBegun(1));
  EXPECT_TRUE(publish(std::string("one\0", 4)));
  ASSERT_TRUE(heard_.hasTold(1));
  EXPECT_EQ(heard_.last(), std::string("one\0", 4));
}

TEST_F(SubscriptionTest, BeginsAgainAfterARestart) {
  const Subscription subscription(*redis_, "news", heard_.listener());
  ASSERT_TRUE(heard_.hasBegun(1));
  server_->kill();
  server_->start();
  ASSERT_TRUE(heard_.hasBegun(2));
  EXPECT_TRUE(publish("after"));
  ASSERT_TRUE(heard_.hasTold(1));
}

TEST_F(SubscriptionTest, NoticesAServerThatHangs) {
  const Subscription subscription(*redis_, "news", heard_.listener());
  ASSERT_TRUE(heard_.hasBegun(1));
  server_->suspend();
  for (const auto end = Clock::now() + 20s; redis_->use().isReachable && Clock::now() < end;) {
    std::this_thread::sleep_for(20ms);
  }
  EXPECT_FALSE(redis_->use().isReachable);
  server_->resume();
  EXPECT_TRUE(heard_.hasBegun(2));
  EXPECT_TRUE(redis_->use().isReachable);
}

TEST_F(SubscriptionTest, OneThatIsRefusedIsTriedEverMoreRarely) {
  ASSERT_TRUE(
      redis_->ask({"ACL", "SETUSER", "deaf", "on", ">word", "~*", "resetchannels", "+@all"}, {Clock::now() + 5s}));
  Redis deaf({.address = *parseAddress(server_->url("deaf:word@"))});
  const auto begun = Clock::now();
  const Subscription subscription(deaf, "news", heard_.listener());
  while (deaf.use().connected < 4) std::this_thread::sleep_for(5ms);
  EXPECT_GE(Clock::now() - begun, 25ms + 50ms + 100ms);
  EXPECT_TRUE(deaf.ask({"PING"}, {Clock::now() + 5s})) << "which other calls do not feel";
}

TEST_F(SubscriptionTest, EndsWhileNobodyAnswers) {
  server_->kill();
  const auto begun = Clock::now();
  { const Subscription subscription(*redis_, "news", heard_.listener()); }
  EXPECT_LT(Clock::now() - begun, 3s);
}

Call soon() {
  return {Clock::now() + 10s, {.bytes = 9 << 20}};
}

class EncryptedTest : public ::testing::Test {
 protected:
  void SetUp() override {
    std::signal(SIGPIPE, SIG_IGN);
    if (!RedisServer::isInstalled()) GTEST_SKIP() << "redis-server is not installed.";
  }

  static Address addressOf(const RedisServer& server) {
    Address address = *parseAddress(server.url());
    address.authorities = server.authorities();
    return address;
  }
};

TEST_F(EncryptedTest, BytesOfAnyNumberComeThrough) {
  const auto server = RedisServer::encrypted("IP:127.0.0.1");
  Redis redis({.address = addressOf(*server)});
  const std::string large(4 << 20, 'y');
  const auto replies = redis.pipeline({{"SET", "k", large}, {"GET", "k"}, {"GET", "k"}}, soon());
  ASSERT_TRUE(replies);
  EXPECT_EQ(replies->back().text, large);
  EXPECT_TRUE(redis.ask({"PING"}, soon()));
  EXPECT_EQ(redis.use().connected, 1u) << "the connection is kept";
}

TEST_F(EncryptedTest, AServerOfAnotherNameIsRefused) {
  const auto server = RedisServer::encrypted("IP:127.0.0.2,DNS:other.example");
  const auto opened = Connection::open(addressOf(*server), soon());
  ASSERT_FALSE(opened);
  EXPECT_NE(opened.problems().front().detail.find("certificate"), std::string::npos)
      << opened.problems().front().detail;
}

TEST_F(EncryptedTest, ACertificateOfNoKnownAuthorityIsRefused) {
  const auto server = RedisServer::encrypted("IP:127.0.0.1");
  Address address = addressOf(*server);
  address.authorities.clear();
  EXPECT_FALSE(Connection::open(address, soon()));
}

TEST_F(EncryptedTest, PlainAndEncryptedDoNotTalk) {
  const auto encrypted = RedisServer::encrypted("IP:127.0.0.1");
  Address asPlain = addressOf(*encrypted);
  asPlain.isEncrypted = false;
  EXPECT_FALSE(Connection::open(asPlain, {Clock::now() + 2s}));
  const RedisServer plain;
  Address asEncrypted = *parseAddress(plain.url());
  asEncrypted.isEncrypted = true;
  EXPECT_FALSE(Connection::open(asEncrypted, {Clock::now() + 2s}));
}

} // namespace
} // namespace gnomon::redis
