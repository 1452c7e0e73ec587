#include "server/http/connection.h"

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

TEST_F(ConnectionTest, AnswersOneAfterTheOther) {
  const std::string received = exchange(
      "GET /a HTTP/1.1\r\nHost: x\r\n\r\nPOST /a/b HTTP/1.1\r\nHost: x\r\nContent-Length: 2\r\n\r\nhi"
      "HEAD /a HTTP/1.1\r\nHost: x\r\n\r\n");
  EXPECT_EQ(countOf(received, "HTTP/1.1 200 OK\r\n"), 3u);
  EXPECT_TRUE(has(received, "\r\n\r\nGET 1 HTTP/1.1"));
  EXPECT_TRUE(has(received, "\r\n\r\nPOST 2 hiHTTP/1.1"));
  EXPECT_TRUE(received.ends_with("\r\n\r\n"));
}

TEST_F(ConnectionTest, SaysNosniffAndPolicyAndTheRequestsId) {
  const std::string received =
      exchange("GET / HTTP/1.1\r\nHost: x\r\nX-Request-ID: abc-1\r\nConnection: close\r\n\r\n");
  EXPECT_TRUE(has(received, "X-Request-ID: abc-1\r\n"));
  EXPECT_TRUE(has(received, "X-Content-Type-Options: nosniff\r\n"));
  EXPECT_TRUE(has(received, "Content-Security-Policy: default-src 'none'\r\n"));
  EXPECT_TRUE(has(received, "Connection: close\r\n"));
}

TEST_F(ConnectionTest, ReplacesAnIdThatCouldForge) {
  EXPECT_FALSE(has(exchange("GET / HTTP/1.1\r\nHost: x\r\nX-Request-ID: {\"a\": 1}\r\n\r\n"), "{\"a\""));
}

TEST_F(ConnectionTest, TellsNothingOfAnException) {
  const std::string received = exchange("GET /throw HTTP/1.1\r\nHost: x\r\n\r\nGET /a HTTP/1.1\r\nHost: x\r\n\r\n");
  EXPECT_TRUE(has(received, "HTTP/1.1 500 "));
  EXPECT_FALSE(has(received, "secret"));
  EXPECT_TRUE(has(received, "HTTP/1.1 200 OK"));
}

TEST_F(ConnectionTest, SendsAStreamPieceByPieceAndEndsWithIt) {
  const std::string received = exchange("GET /stream HTTP/1.1\r\nHost: x\r\n\r\nGET /a HTTP/1.1\r\nHost: x\r\n\r\n");
  EXPECT_TRUE(received.starts_with("HTTP/1.1 200 OK\r\n"));
  EXPECT_FALSE(has(received, "Content-Length"));
  EXPECT_TRUE(has(received, "Connection: close\r\n"));
  EXPECT_TRUE(received.ends_with("\r\n\r\npiece piece piece ")) << "and no second reply";
  EXPECT_FALSE(has(received, "secret"));
}

TEST_F(ConnectionTest, AStreamLearnsThatItsClientIsGone) {
  std::atomic<bool> told = false;
  context_.service = [&](const HttpRequest&) {
    RequestHandler handler;
    handler.answer = [&](const HttpRequest&, const std::function<bool()>&) {
      HttpReply reply;
      reply.stream = [&](const BodySink& sink) {
        while (sink(std::string(4096, 'x'))) {
        }
        told = !sink("more");
        return nullptr;
      };
      return reply;
    };
    return handler;
  };
  const auto pending = enter();
  EXPECT_TRUE(sendAll(client_.get(), "GET / HTTP/1.1\r\nHost: x\r\n\r\n", Pace{}));
  char first = 0;
  EXPECT_EQ(::recv(client_.get(), &first, 1, 0), 1);
  client_.reset();
  pending->finish();
  EXPECT_TRUE(told);
}

TEST_F(ConnectionTest, InvitesABodyOnlyWhenItIsWanted) {
  EXPECT_TRUE(exchange("POST /a HTTP/1.1\r\nHost: x\r\nExpect: 100-continue\r\nContent-Length: 2\r\n\r\nhi")
                  .starts_with("HTTP/1.1 100 Continue\r\n\r\nHTTP/1.1 200 OK"));
}

TEST_F(ConnectionTest, RefusesABodyUnread) {
  const std::string received =
      exchange("POST /a HTTP/1.1\r\nHost: x\r\nExpect: 100-continue\r\nContent-Length: 101\r\n\r\n");
  EXPECT_TRUE(received.starts_with("HTTP/1.1 413 "));
  EXPECT_TRUE(has(received, "Connection: close\r\n"));
}

TEST_F(ConnectionTest, ABodyThatIsNotReadIsNoRequest) {
  const std::string received = exchange(
      "POST /refused HTTP/1.1\r\nHost: x\r\nContent-Length: 40\r\n\r\nGET /smuggled HTTP/1.1\r\nHost: x\r\n\r\n");
  EXPECT_EQ(countOf(received, "HTTP/1.1 "), 1u);
  EXPECT_TRUE(received.starts_with("HTTP/1.1 404 "));
}

TEST_F(ConnectionTest, StaysAfterARefusalWithoutABody) {
  const std::string received = exchange("GET /refused HTTP/1.1\r\nHost: x\r\n\r\nGET /a HTTP/1.1\r\nHost: x\r\n\r\n");
  EXPECT_EQ(countOf(received, "HTTP/1.1 "), 2u);
}

TEST_F(ConnectionTest, RefusesLongHeads) {
  EXPECT_TRUE(exchange("GET /" + std::string(kMaxHeadBytes, 'a')).starts_with("HTTP/1.1 431 "));
}

TEST_F(ConnectionTest, RefusesBrokenHeads) {
  EXPECT_TRUE(exchange("nonsense\r\n\r\n").starts_with("HTTP/1.1 400 "));
}

TEST_F(ConnectionTest, GivesUpOnAHeadThatNeverEnds) {
  context_.limits.head = 20ms;
  const auto pending = enter();
  EXPECT_TRUE(sendAll(client_.get(), "GET / HT", Pace{}));
  EXPECT_TRUE(readAll().starts_with("HTTP/1.1 408 "));
}

TEST_F(ConnectionTest, StopsBetweenRequests) {
  context_.limits.firstByte = 1h;
  const auto pending = enter();
  pending->finish();
  EXPECT_EQ(readAll(), "");
}

TEST_F(ConnectionTest, EndsAfterItsLastRequest) {
  context_.limits.maxRequests = 2;
  const std::string get = "GET / HTTP/1.1\r\nHost: x\r\n\r\n";
  const std::string received = exchange(get + get + get);
  EXPECT_EQ(countOf(received, "HTTP/1.1 200"), 2u);
  EXPECT_EQ(countOf(received, "Connection: close"), 1u);
}

TEST_F(ConnectionTest, AnEmptyLineMayPrecedeARequest) {
  const std::string received = exchange(
      "\r\nGET /a HTTP/1.1\r\nHost: x\r\n\r\nPOST /b HTTP/1.1\r\nHost: x\r\nContent-Length: 2\r\n\r\nhi\r\n"
      "GET /a HTTP/1.1\r\nHost: x\r\n\r\n");
  EXPECT_EQ(countOf(received, "HTTP/1.1 200 OK\r\n"), 3u);
}

TEST_F(ConnectionTest, AnEmptyLineAfterABodyIsNoSlowRequest) {
  context_.limits.head = 20ms;
  const auto pending = enter();
  EXPECT_TRUE(sendAll(client_.get(), "POST / HTTP/1.1\r\nHost: x\r\nContent-Length: 2\r\n\r\nhi\r\n", Pace{}));
  std::this_thread::sleep_for(100ms);
  EXPECT_TRUE(sendAll(client_.get(), "GET / HTTP/1.1\r\nHost: x\r\nConnection: close\r\n\r\n", Pace{}));
  EXPECT_EQ(countOf(readAll(), "HTTP/1.1 200 OK\r\n"), 2u);
}

TEST_F(ConnectionTest, InvitesNoBodyFromAnOldClient) {
  EXPECT_TRUE(exchange("POST /a HTTP/1.0\r\nExpect: 100-continue\r\nContent-Length: 2\r\n\r\nhi")
                  .starts_with("HTTP/1.1 200 OK"));
}

TEST_F(ConnectionTest, SaysHowLongItWaitsForTheNextRequest) {
  context_.limits.idle = 7s;
  EXPECT_TRUE(has(exchange("GET / HTTP/1.1\r\nHost: x\r\n\r\n"), "Keep-Alive: timeout=7\r\n"));
}

TEST_F(ConnectionTest, ClosesWhatIsIdleForTooLong) {
  context_.limits.idle = 50ms;
  const auto pending = enter();
  EXPECT_TRUE(sendAll(client_.get(), "GET / HTTP/1.1\r\nHost: x\r\n\r\n", Pace{}));
  const auto start = Clock::now();
  EXPECT_TRUE(has(readAll(), "Connection: keep-alive\r\n"));
  EXPECT_GE(Clock::now() - start, 40ms);
}

TEST_F(ConnectionTest, AStrayByteAfterTheLastReplyDoesNotResetIt) {
  const auto pending = enter();
  ASSERT_TRUE(sendAll(client_.get(), "GET / HTTP/1.0\r\n\r\n\r\n", Pace{}));
  EXPECT_TRUE(readAll().ends_with("GET 0 "));
  char byte = 0;
  EXPECT_EQ(::recv(client_.get(), &byte, 1, 0), 0);
}

TEST_F(ConnectionTest, RepliesThatNobodyTakesLeaveRoomForNoOther) {
  context_.limits.replyRoom = 20ms;
  context_.service = [](const HttpRequest&) {
    RequestHandler handler;
    handler.answer = [](const HttpRequest&, const std::function<bool()>&) {
      HttpReply reply;
      reply.contentType = "text/plain";
      reply.body = std::string(1 << 20, 'x'); // all of the budget, and more than the socket holds
      return reply;
    };
    return std::variant<RequestHandler, HttpReply>(handler);
  };
  const auto pending = enter();
  const std::vector<FileDescriptor> taker = connect(*pending, 1, "other");
  ASSERT_TRUE(sendAll(taker[0].get(), "GET / HTTP/1.1\r\nHost: x\r\n\r\n", Pace{}));
  char byte = 0;
  ASSERT_EQ(::recv(taker[0].get(), &byte, 1, 0), 1);
  ASSERT_TRUE(sendAll(client_.get(), "GET / HTTP/1.1\r\nHost: x\r\nConnection: close\r\n\r\n", Pace{}));
  const std::string received = readAll();
  EXPECT_TRUE(received.starts_with("HTTP/1.1 503 "));
  EXPECT_TRUE(has(received, "Retry-After: 10\r\n"));
}

/// The last request's end.
class LastEnd : public RequestObserver {
 public:
  void ended(const RequestRecord& record, const HttpReply&) noexcept override { delivery.set_value(record.delivery); }
  std::promise<Delivery> delivery;
};

// As a video's encoder does; both are held for a key, which the connection does not know before its handler does.
TEST_F(ConnectionTest, AStreamYieldsForOtherMemoryThatItHoldsForItsKey) {
  const ClientIdentity key{"key a", "key a"};
  ByteBudget memory(60 << 20); // to be given back in 60 s: at 1 MiB a second
  ByteLease held(memory, {key, "asked"}), wanted(memory, {{"b", "b"}, "2"});
  ASSERT_TRUE(held.grow(60 << 20));
  ASSERT_FALSE(wanted.grow(1));
  LastEnd last;
  context_.observer = &last;
  context_.service = [&](const HttpRequest&) -> std::variant<RequestHandler, HttpReply> {
    RequestHandler handler;
    handler.answer = [&](const HttpRequest&, const std::function<bool()>&) {
      HttpReply reply;
      reply.contentType = "text/plain";
      reply.client = key;
      reply.memory = &memory;
      reply.stream = [piece = std::string(1 << 16, 'x')](const BodySink& sink) -> std::shared_ptr<ReplyWait> {
        while (sink(piece)) {
        }
        return nullptr;
      };
      return reply;
    };
    return handler;
  };
  const auto pending = enter();
  ASSERT_TRUE(sendAll(client_.get(), "GET / HTTP/1.1\r\nHost: x\r\nX-Request-ID: asked\r\n\r\n", Pace{}));
  auto ended = last.delivery.get_future();
  for (const auto end = Clock::now() + 60s; Clock::now() < end;) {
    if (ended.wait_for(100ms) == std::future_status::ready) break;
    EXPECT_FALSE(wanted.grow(1)); // it asks again
  }
  ASSERT_EQ(ended.wait_for(0s), std::future_status::ready);
  EXPECT_EQ(ended.get(), Delivery::othersWaited);
}

TEST_F(ConnectionTest, AReplyThatHasItsRoomNeedsNoOther) {
  context_.limits.replyRoom = 20ms;
  context_.service = [this](const HttpRequest&) {
    RequestHandler handler;
    handler.answer = [this](const HttpRequest&, const std::function<bool()>&) {
      HttpReply reply;
      reply.contentType = "text/plain";
      reply.body = std::string(replyBytes_.total(), 'x');
      EXPECT_TRUE(reply.room.await(replyBytes_, {}, reply.body.size(), Clock::now(), [] { return true; }));
      return reply;
    };
    return std::variant<RequestHandler, HttpReply>(handler);
  };
  EXPECT_TRUE(exchange("GET / HTTP/1.1\r\nHost: x\r\nConnection: close\r\n\r\n").starts_with("HTTP/1.1 200 "));
  EXPECT_EQ(replyBytes_.used(), 0u);
}

TEST_F(ConnectionTest, ABodyIsGivenBackBeforeItsReplyIsTaken) {
  context_.service = [](const HttpRequest&) {
    RequestHandler handler;
    handler.body = {BodyRule::Framing::any, 1 << 20};
    handler.answer = [](const HttpRequest&, const std::function<bool()>&) {
      HttpReply reply;
      reply.contentType = "text/plain";
      reply.body = std::string(1 << 20, 'x');
      return reply;
    };
    return std::variant<RequestHandler, HttpReply>(handler);
  };
  const auto pending = enter();
  ASSERT_TRUE(sendAll(client_.get(),
                      "POST / HTTP/1.1\r\nHost: x\r\nContent-Length: 1000\r\n\r\n" + std::string(1000, 'x'), Pace{}));
  char byte = 0;
  ASSERT_EQ(::recv(client_.get(), &byte, 1, 0), 1);
  EXPECT_EQ(context_.bodyBytes.used(), 0u);
  client_.reset();
}

} // namespace
} // namespace gnomon
