#include "server/http/pending_connections.h"

#include <array>
#include <atomic>
#include <future>
#include <gtest/gtest.h>
#include <memory>
#include <optional>
#include <string_view>
#include <sys/socket.h>
#include <thread>
#include <vector>

#include "tests/server/http/connection_fixture.h"

namespace gnomon {
namespace {

TEST_F(ConnectionTest, IdleConnectionsHoldNoThread) {
  const auto pending = enter(); // of two threads
  std::vector<FileDescriptor> idle;
  for (int i = 0; i < 10; ++i) {
    int fds[2];
    ASSERT_EQ(::socketpair(AF_UNIX, SOCK_STREAM, 0, fds), 0);
    idle.emplace_back(fds[0]);
    pending->adopt({FileDescriptor(fds[1]), {"idle", "idle"}});
    ASSERT_TRUE(sendAll(fds[0], "GET / HTTP/1.1\r\nHost: x\r\n\r\n", Pace{}));
    char bytes[4096];
    ASSERT_GT(::recv(fds[0], bytes, sizeof bytes, 0), 0);
  }
  ASSERT_TRUE(sendAll(client_.get(), "GET / HTTP/1.1\r\nHost: x\r\nConnection: close\r\n\r\n", Pace{}));
  EXPECT_TRUE(readAll().starts_with("HTTP/1.1 200 OK"));
}

TEST_F(ConnectionTest, WhoWaitsMostGivesRoom) {
  context_.limits.maxWaiting = 4;
  const auto pending = enter();
  ASSERT_TRUE(sendAll(client_.get(), "GET / HTTP/1.1\r\nHos", Pace{}));
  std::vector<FileDescriptor> many;
  for (int i = 0; i < 40; ++i) {
    int fds[2];
    ASSERT_EQ(::socketpair(AF_UNIX, SOCK_STREAM, 0, fds), 0);
    many.emplace_back(fds[0]);
    pending->adopt({FileDescriptor(fds[1]), {"many", "many"}});
  }
  ASSERT_TRUE(sendAll(client_.get(), "t: x\r\nConnection: close\r\n\r\n", Pace{}));
  EXPECT_TRUE(readAll().starts_with("HTTP/1.1 200 OK"));
  char byte = 0;
  EXPECT_EQ(::recv(many.front().get(), &byte, 1, 0), 0) << "the first of the many is closed";
}

TEST_F(ConnectionTest, AWholeHeadIsNotDroppedForRoom) {
  context_.limits.maxWaiting = 2;
  ASSERT_TRUE(sendAll(client_.get(), "GET / HTTP/1.1\r\nHost: x\r\nConnection: close\r\n\r\n", Pace{}));
  const auto pending = enter();
  std::vector<FileDescriptor> many;
  for (int i = 0; i < 40; ++i) {
    int fds[2];
    ASSERT_EQ(::socketpair(AF_UNIX, SOCK_STREAM, 0, fds), 0);
    many.emplace_back(fds[0]);
    pending->adopt({FileDescriptor(fds[1]), {"client", "client"}});
  }
  EXPECT_TRUE(readAll().starts_with("HTTP/1.1 200 OK"));
}

/// No thread is free: another client's request holds the only one until it is released.
class FullServerTest : public ConnectionTest {
 protected:
  FullServerTest() {
    context_.service = [this, echoes = echoService()](const HttpRequest& head) {
      if (head.path != std::vector<std::string>{"hold"}) {
        return echoes(head);
      }
      RequestHandler handler;
      handler.answer = [this](const HttpRequest&, const std::function<bool()>&) {
        held_.set_value();
        released_.get_future().wait();
        return HttpReply{};
      };
      return std::variant<RequestHandler, HttpReply>(handler);
    };
    int fds[2];
    EXPECT_EQ(::socketpair(AF_UNIX, SOCK_STREAM, 0, fds), 0);
    holder_ = FileDescriptor(fds[0]);
    pending_.emplace(context_, 2, 1);
    pending_->adopt({FileDescriptor(fds[1]), {"holder", "holder"}});
    EXPECT_TRUE(sendAll(holder_.get(), "GET /hold HTTP/1.1\r\nHost: x\r\n\r\n", Pace{}));
    held_.get_future().wait();
  }
  ~FullServerTest() override { released_.set_value(); }

  /// What a client gets; `network`: "holder" has its share of the threads already.
  std::string ask(const std::string& sent, const std::string& network) {
    pending_->adopt({std::move(server_), {network, network}});
    EXPECT_TRUE(sendAll(client_.get(), sent, Pace{}));
    ::shutdown(client_.get(), SHUT_WR);
    return readAll();
  }

  std::promise<void> held_, released_;
  FileDescriptor holder_;
  std::optional<PendingConnections> pending_;
};

TEST_F(FullServerTest, AnswersProbes) {
  EXPECT_TRUE(ask("GET /probe HTTP/1.1\r\nHost: x\r\n\r\n", "holder").starts_with("HTTP/1.1 200 OK"));
}

TEST_F(FullServerTest, AClientWithItsShareIsTurnedAway) {
  const std::string received = ask("GET /a HTTP/1.1\r\nHost: x\r\n\r\n", "holder");
  EXPECT_TRUE(received.starts_with("HTTP/1.1 429 "));
  EXPECT_TRUE(has(received, "Retry-After: 1\r\n"));
  EXPECT_TRUE(has(received, "Connection: close\r\n"));
}

TEST_F(FullServerTest, WhoAsksMostIsRefusedWhereAllAsk) {
  context_.limits.maxWaiting = 4;
  context_.limits.threadWait = std::chrono::seconds(30);
  std::vector<FileDescriptor> many;
  for (int i = 0; i < 40; ++i) {
    int fds[2];
    ASSERT_EQ(::socketpair(AF_UNIX, SOCK_STREAM, 0, fds), 0);
    many.emplace_back(fds[0]);
    ASSERT_TRUE(sendAll(fds[0], "GET /a HTTP/1.1\r\nHost: x\r\n\r\n", Pace{}));
    pending_->admit({FileDescriptor(fds[1]), {"holder", "holder"}});
  }
  EXPECT_TRUE(ask("GET /a HTTP/1.1\r\nHost: x\r\n\r\n", "other").starts_with("HTTP/1.1 200 OK"));
  std::array<char, 12> status{};
  ASSERT_EQ(::recv(many.back().get(), status.data(), status.size(), MSG_WAITALL), 12);
  EXPECT_EQ(std::string_view(status.data(), status.size()), "HTTP/1.1 503");
  EXPECT_LT(::recv(many.front().get(), status.data(), status.size(), MSG_DONTWAIT), 0) << "it waits still";
}

TEST_F(FullServerTest, AnotherClientIsServed) {
  EXPECT_TRUE(ask("GET /a HTTP/1.1\r\nHost: x\r\n\r\n", "other").starts_with("HTTP/1.1 200 OK"));
}

TEST_F(FullServerTest, AReplyToABrokenHeadHasAnId) {
  const std::string received = ask("nonsense\r\n\r\n", "holder");
  EXPECT_TRUE(received.starts_with("HTTP/1.1 400 "));
  EXPECT_FALSE(has(received, "X-Request-ID: \r\n"));
  EXPECT_TRUE(has(received, "\"instance\""));
}

} // namespace
} // namespace gnomon
