#include <atomic>
#include <future>
#include <gtest/gtest.h>
#include <memory>
#include <optional>
#include <sys/socket.h>
#include <thread>
#include <vector>

#include "tests/server/http/connection_fixture.h"

namespace gnomon {
namespace {

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
