#include "server/redis/stream.h"

#include <csignal>
#include <gtest/gtest.h>

#include "server/redis/redis.h"
#include "tests/support/redis_server.h"

namespace gnomon::redis {
namespace {

using namespace std::chrono_literals;
using testing::RedisServer;

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
