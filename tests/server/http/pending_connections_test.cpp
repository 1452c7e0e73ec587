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
  const std::vector<FileDescriptor> clients = connect(*pending, 10, "idle");
  for (const FileDescriptor& idle : clients) {
    ASSERT_TRUE(sendAll(idle.get(), "GET / HTTP/1.1\r\nHost: x\r\n\r\n", Pace{}));
    char bytes[4096];
    ASSERT_GT(::recv(idle.get(), bytes, sizeof bytes, 0), 0);
  }
  ASSERT_TRUE(sendAll(client_.get(), "GET / HTTP/1.1\r\nHost: x\r\nConnection: close\r\n\r\n", Pace{}));
  EXPECT_TRUE(readAll().starts_with("HTTP/1.1 200 OK"));
}

TEST_F(ConnectionTest, WhoWaitsMostGivesRoom) {
  context_.limits.maxWaiting = 4;
  const auto pending = enter();
  ASSERT_TRUE(sendAll(client_.get(), "GET / HTTP/1.1\r\nHos", Pace{}));
  const std::vector<FileDescriptor> many = connect(*pending, 40, "many");
  ASSERT_TRUE(sendAll(client_.get(), "t: x\r\nConnection: close\r\n\r\n", Pace{}));
  EXPECT_TRUE(readAll().starts_with("HTTP/1.1 200 OK"));
  char byte = 0;
  EXPECT_EQ(::recv(many.front().get(), &byte, 1, 0), 0) << "the first of the many is closed";
}

TEST_F(ConnectionTest, AWholeHeadIsNotDroppedForRoom) {
  context_.limits.maxWaiting = 2;
  ASSERT_TRUE(sendAll(client_.get(), "GET / HTTP/1.1\r\nHost: x\r\nConnection: close\r\n\r\n", Pace{}));
  const auto pending = enter();
  const std::vector<FileDescriptor> many = connect(*pending, 40, "client");
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
    pending_.emplace(context_, 2, 1);
    holder_ = std::move(connect(*pending_, 1, "holder").front());
    EXPECT_TRUE(sendAll(holder_.get(), "GET /hold HTTP/1.1\r\nHost: x\r\n\r\n", Pace{}));
    held_.get_future().wait();
  }
  ~FullServerTest() override { released_.set_value(); }

  /// What a client gets; `network`: "holder" has its share of the threads already.
  std::string ask(const std::string& sent, const std::string& network) {
    pending_->adopt({std::move(server_), {network, {network, network}}});
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
    SocketPair pair;
    ASSERT_TRUE(sendAll(pair.client.get(), "GET /a HTTP/1.1\r\nHost: x\r\n\r\n", Pace{}));
    pending_->admit({std::move(pair.server), {"holder", {"holder", "holder"}}});
    many.push_back(std::move(pair.client));
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

/// A handler that waits until its client has left, at most two seconds; tells whether it did.
class LeavingTest : public ConnectionTest {
 protected:
  LeavingTest() {
    context_.service = [this](const HttpRequest&) {
      RequestHandler handler;
      handler.answer = [this](const HttpRequest&, const std::function<bool()>& clientGone) {
        begun_.set_value();
        const auto end = Clock::now() + 2s;
        while (!(left_ = clientGone()) && !enough_ && Clock::now() < end) {
          std::this_thread::sleep_for(5ms);
        }
        HttpReply reply;
        reply.contentType = "text/plain";
        reply.body = "the frame";
        return reply;
      };
      return std::variant<RequestHandler, HttpReply>(handler);
    };
  }

  std::unique_ptr<PendingConnections> begin(const std::string& request) {
    auto pending = enter();
    EXPECT_TRUE(sendAll(client_.get(), request, Pace{}));
    begun_.get_future().wait();
    return pending;
  }

  std::promise<void> begun_;
  std::atomic<bool> left_ = false, enough_ = false;
};

TEST_F(LeavingTest, BytesThatWereSentAheadHideNothing) {
  const auto pending = begin("GET / HTTP/1.1\r\nHost: x\r\n\r\nGET /next");
  const auto start = Clock::now();
  client_.reset();
  pending->finish();
  EXPECT_TRUE(left_);
  EXPECT_LT(Clock::now() - start, 1s);
}

TEST_F(LeavingTest, AClientThatSendsNoMoreStillGetsItsReply) {
  const auto pending = begin("GET / HTTP/1.1\r\nHost: x\r\n\r\n");
  ::shutdown(client_.get(), SHUT_WR);
  std::this_thread::sleep_for(50ms);
  EXPECT_FALSE(left_);
  enough_ = true;
  const std::string received = readAll();
  EXPECT_TRUE(received.starts_with("HTTP/1.1 100 Continue\r\n\r\nHTTP/1.1 200 OK\r\n")) << received;
  EXPECT_TRUE(received.ends_with("the frame"));
}

TEST_F(LeavingTest, AnOldClientIsNotSentWhatItDoesNotKnow) {
  const auto pending = begin("GET / HTTP/1.0\r\n\r\n");
  ::shutdown(client_.get(), SHUT_WR);
  std::this_thread::sleep_for(50ms);
  enough_ = true;
  EXPECT_TRUE(readAll().starts_with("HTTP/1.1 200 OK\r\n"));
}

} // namespace
} // namespace gnomon
