#include "server/redis/redis.h"

#include <arpa/inet.h>
#include <array>
#include <atomic>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <thread>

#include "tests/support/redis_server.h"

namespace gnomon::redis {
namespace {

using namespace std::chrono_literals;
using testing::RedisServer;

Call within(Clock::duration patience, ReplyLimits limits = {}) {
  return {Clock::now() + patience, limits};
}

/// Asks until the server answers again; false after some seconds.
bool comesBack(Redis& redis) {
  for (const auto end = Clock::now() + 20s; Clock::now() < end;) {
    if (redis.ask({"PING"}, within(1s))) return true;
    std::this_thread::sleep_until(std::max(redis.nextAttempt(), Clock::now() + 5ms));
  }
  return false;
}

class RedisTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!RedisServer::isInstalled()) GTEST_SKIP() << "redis-server is not installed.";
    server_ = std::make_unique<RedisServer>();
  }

  Options options() const { return {.address = *parseAddress(server_->url())}; }

  std::unique_ptr<RedisServer> server_;
};

TEST_F(RedisTest, AnswersEachCommandOfAPipelineInOrder) {
  Redis redis(options());
  const std::string bytes("a\0b\r\n", 5);
  const auto replies = redis.pipeline(
      {{"SET", "key", bytes}, {"GET", "key"}, {"LPUSH", "key", "x"}, {"GET", "none"}, {"INCR", "count"}}, within(5s));
  ASSERT_TRUE(replies);
  ASSERT_EQ(replies->size(), 5u);
  EXPECT_EQ((*replies)[0].text, "OK");
  EXPECT_EQ((*replies)[1].text, bytes);
  EXPECT_TRUE((*replies)[2].isError("WRONGTYPE"));
  EXPECT_TRUE((*replies)[3].isNil());
  EXPECT_EQ((*replies)[4].integer, 1);
  EXPECT_EQ(redis.use().connected, 1u);
}

TEST_F(RedisTest, SendsAndReadsMoreThanBuffersHold) {
  Redis redis(options());
  const std::string large(4 << 20, 'x');
  std::vector<Command> commands;
  for (int i = 0; i < 4; ++i) {
    commands.push_back({"SET", "large", large});
    commands.push_back({"GET", "large"});
  }
  const auto replies = redis.pipeline(commands, within(20s, {.bytes = 17 << 20}));
  ASSERT_TRUE(replies);
  EXPECT_EQ(replies->back().text, large);
}

TEST_F(RedisTest, AScriptIsSentOnceAndAgainAfterARestart) {
  Redis redis(options());
  const Script script("return {KEYS[1], ARGV[1]}");
  for (int i = 0; i < 2; ++i) {
    const auto reply = redis.run(script, {"k"}, {"v"}, within(5s));
    ASSERT_TRUE(reply);
    ASSERT_EQ(reply->elements.size(), 2u);
    EXPECT_EQ(reply->elements[1].text, "v");
    const auto known = redis.ask({"SCRIPT", "EXISTS", script.sha1()}, within(5s));
    EXPECT_EQ(known->elements[0].integer, 1);
    ASSERT_TRUE(redis.ask({"SCRIPT", "FLUSH"}, within(5s)));
  }
}

TEST_F(RedisTest, AReplyLargerThanAskedForEndsTheConnection) {
  Redis redis(options());
  ASSERT_TRUE(redis.ask({"SET", "large", std::string(1'000'000, 'x')}, within(5s)));
  const auto refused = redis.ask({"GET", "large"}, within(5s, {.bytes = 100'000}));
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.problems().front().code, ProblemCode::unavailable);
  EXPECT_TRUE(comesBack(redis));
}

TEST_F(RedisTest, CallsOfManyThreadsShareTheConnections) {
  Options few = options();
  few.connections = 3;
  Redis redis(few);
  std::atomic<int> failed = 0;
  std::vector<std::thread> threads;
  for (int i = 0; i < 12; ++i) {
    threads.emplace_back([&] {
      for (int k = 0; k < 50; ++k) failed += redis.ask({"INCR", "n"}, within(20s)) ? 0 : 1;
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(failed, 0);
  EXPECT_EQ(redis.ask({"GET", "n"}, within(5s))->text, "600");
  EXPECT_LE(redis.use().connected, 3u);
  EXPECT_LE(redis.use().connections, 3u);
}

TEST_F(RedisTest, ACallThatWaitsInTheServerCanBeCut) {
  Options one = options();
  one.connections = 1;
  Redis redis(one);
  StopSignal cut;
  std::atomic<bool> ended = false;
  std::thread blocked([&] {
    const Call call{Clock::now() + 60s, {}, &cut};
    EXPECT_FALSE(redis.ask({"BLPOP", "never", "50"}, call));
    ended = true;
  });
  std::this_thread::sleep_for(100ms);
  EXPECT_FALSE(ended);
  cut.raise();
  blocked.join();
  EXPECT_TRUE(redis.use().isReachable) << "cutting a call says nothing about the server";
  EXPECT_TRUE(redis.ask({"PING"}, within(5s)));
}

TEST_F(RedisTest, AStreamIsReadByAGroup) {
  Redis redis(options());
  ASSERT_TRUE(redis.ask({"XGROUP", "CREATE", "jobs", "all", "$", "MKSTREAM"}, within(5s)));
  ASSERT_TRUE(redis.ask({"XADD", "jobs", "*", "frame", "7"}, within(5s)));
  const auto read = redis.ask(
      {"XREADGROUP", "GROUP", "all", "me", "COUNT", "1", "BLOCK", "1000", "STREAMS", "jobs", ">"}, within(5s));
  ASSERT_TRUE(read);
  ASSERT_TRUE(read->isArray());
  const Reply& entry = read->elements[0].elements[1].elements[0];
  EXPECT_EQ(entry.elements[1].elements[1].text, "7");
  EXPECT_EQ(redis.ask({"XACK", "jobs", "all", entry.elements[0].text}, within(5s))->integer, 1);
}

TEST_F(RedisTest, AServerThatDiedAndCameBackIsFoundAgain) {
  Redis redis(options());
  ASSERT_TRUE(redis.ask({"SET", "key", "kept"}, within(5s)));
  server_->kill();
  EXPECT_FALSE(redis.ask({"GET", "key"}, within(5s)));
  EXPECT_FALSE(redis.use().isReachable);
  const auto begun = Clock::now();
  for (int i = 0; i < 1'000; ++i) EXPECT_FALSE(redis.ask({"GET", "key"}, within(5s)));
  EXPECT_LT(Clock::now() - begun, 3s) << "calls fail at once while it is away";
  server_->start();
  ASSERT_TRUE(comesBack(redis));
  EXPECT_EQ(redis.ask({"GET", "key"}, within(5s))->text, "kept");
  EXPECT_TRUE(redis.use().isReachable);
}

TEST_F(RedisTest, ARestartBetweenTwoCallsIsNotNoticed) {
  Redis redis(options());
  ASSERT_TRUE(redis.ask({"PING"}, within(5s)));
  server_->kill();
  server_->start();
  EXPECT_TRUE(redis.ask({"PING"}, within(5s)));
}

TEST_F(RedisTest, AServerThatHangsCostsNoMoreThanTheDeadline) {
  Redis redis(options());
  ASSERT_TRUE(redis.ask({"PING"}, within(5s)));
  server_->suspend();
  const auto begun = Clock::now();
  EXPECT_FALSE(redis.ask({"PING"}, within(200ms)));
  EXPECT_FALSE(redis.ask({"PING"}, within(200ms)));
  EXPECT_LT(Clock::now() - begun, 3s);
  server_->resume();
  EXPECT_TRUE(comesBack(redis));
}

TEST_F(RedisTest, CallsThatFailTogetherAreOneFailure) {
  Redis redis(options());
  ASSERT_TRUE(redis.ask({"PING"}, within(5s)));
  server_->suspend();
  std::vector<std::thread> threads;
  for (int i = 0; i < 8; ++i) {
    threads.emplace_back([&] { EXPECT_FALSE(redis.ask({"PING"}, within(200ms))); });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_LE(redis.nextAttempt(), Clock::now() + 100ms) << "it is soon tried again";
  server_->resume();
  EXPECT_TRUE(comesBack(redis));
}

TEST(RedisPassword, IsAskedForAndTaken) {
  if (!RedisServer::isInstalled()) GTEST_SKIP() << "redis-server is not installed.";
  RedisServer server({"--requirepass", "se:cret"});
  Redis right({.address = *parseAddress(server.url(":se%3Acret@"))});
  EXPECT_TRUE(right.ask({"PING"}, within(5s)));
  for (const char* user : {"", ":wrong@", "nobody:se%3Acret@"}) {
    Redis wrong({.address = *parseAddress(server.url(user))});
    EXPECT_FALSE(wrong.ask({"PING"}, within(5s))) << user;
  }
}

/// Answers whoever connects with these bytes, over and over where `isEndless`, whatever it is asked.
class HostileServer {
 public:
  HostileServer(std::string answer, bool isEndless) : listening_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = ::htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    auto* const general = reinterpret_cast<sockaddr*>(&address);
    EXPECT_EQ(::bind(listening_.get(), general, size), 0);
    EXPECT_EQ(::listen(listening_.get(), 8), 0);
    ::getsockname(listening_.get(), general, &size);
    port_ = ::ntohs(address.sin_port);
    thread_ = std::thread([this, answer = std::move(answer), isEndless] { serve(answer, isEndless); });
  }
  ~HostileServer() {
    ::shutdown(listening_.get(), SHUT_RDWR);
    thread_.join();
  }

  std::string url() const { return "redis://127.0.0.1:" + std::to_string(port_); }

 private:
  void serve(const std::string& answer, bool isEndless) const {
    while (true) {
      const FileDescriptor client(::accept(listening_.get(), nullptr, nullptr));
      if (!client) return;
      while (::send(client.get(), answer.data(), answer.size(), MSG_NOSIGNAL) > 0 && isEndless) {
      }
      std::array<char, 256> ignored;
      while (::recv(client.get(), ignored.data(), ignored.size(), 0) > 0) {
      }
    }
  }

  FileDescriptor listening_;
  std::uint16_t port_ = 0;
  std::thread thread_;
};

TEST(RedisHostile, NoAnswerCostsMoreThanTheLimits) {
  for (const auto& [answer, isEndless] : {std::pair<std::string, bool>("+" + std::string(1'000, 'x'), true),
                                          {"$2147483647\r\n" + std::string(1'000, 'x'), true},
                                          {"*1\r\n", true},
                                          {"*2147483647\r\n:1\r\n", true},
                                          {"+PONG\r\n", true},
                                          {"HTTP/1.1 400 Bad Request\r\n\r\n", false},
                                          {std::string(64, '\0'), false},
                                          {"", false}}) {
    const HostileServer server(answer, isEndless);
    Redis redis({.address = *parseAddress(server.url()), .connectPatience = 500ms});
    const auto begun = Clock::now();
    // A sound reply may be taken for one before the next ones arrive, which nobody asked for.
    bool isAnswered = true;
    while (isAnswered && Clock::now() - begun < 10s)
      isAnswered = static_cast<bool>(redis.ask({"GET", "key"}, within(1s)));
    EXPECT_FALSE(isAnswered) << answer.substr(0, 20);
    EXPECT_LT(Clock::now() - begun, 10s);
  }
}

TEST(RedisNobody, FailsAtOnce) {
  Redis redis({.address = *parseAddress("redis://127.0.0.1:" + std::to_string(testing::freePort()))});
  const auto refused = redis.ask({"PING"}, within(5s));
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.problems().front().code, ProblemCode::unavailable);
  EXPECT_EQ(redis.use().failures, 1u);
  Redis unnamed({.address = *parseAddress("redis://no-such-host.invalid")});
  EXPECT_FALSE(unnamed.ask({"PING"}, within(3s)));
}

} // namespace
} // namespace gnomon::redis
