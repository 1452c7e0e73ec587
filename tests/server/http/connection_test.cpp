#include "server/http/connection.h"

#include <atomic>
#include <gtest/gtest.h>
#include <stdexcept>
#include <sys/socket.h>
#include <thread>

#include "server/http/overflow_lane.h"
#include "server/http/reply.h"

namespace gnomon {
namespace {

using namespace std::chrono_literals;

/// Echoes method, path and body; "/throw" throws, "/stream" streams and then throws, "/none" takes no body, "/probe" is
/// a probe.
HttpReply echo(const HttpRequest& request) {
  if (request.path == std::vector<std::string>{"throw"}) {
    throw std::runtime_error("secret");
  }
  HttpReply reply;
  reply.contentType = "text/plain";
  if (request.path == std::vector<std::string>{"stream"}) {
    reply.stream = [](const BodySink& sink) {
      for (int i = 0; i < 3 && sink("piece "); ++i) {
      }
      throw std::runtime_error("secret");
    };
    return reply;
  }
  reply.body = request.method + " " + std::to_string(request.path.size()) + " " + std::string(asText(request.body));
  return reply;
}

HttpService echoService() {
  return [](const HttpRequest& head) -> std::variant<RequestHandler, HttpReply> {
    if (head.path == std::vector<std::string>{"refused"}) {
      return problemReply({{ProblemCode::notFound, "", "No.", "", ""}}, head.id);
    }
    RequestHandler handler;
    handler.body = head.method == "POST" ? BodyRule{BodyRule::Framing::any, 100} : BodyRule{};
    handler.isProbe = head.path == std::vector<std::string>{"probe"};
    handler.answer = [](const HttpRequest& request, const std::function<bool()>&) { return echo(request); };
    return handler;
  };
}

class ConnectionTest : public ::testing::Test {
 protected:
  ConnectionTest() : context_{echoService(), {}, ByteBudget(1 << 20), {}} {
    int fds[2];
    EXPECT_EQ(::socketpair(AF_UNIX, SOCK_STREAM, 0, fds), 0);
    client_ = FileDescriptor(fds[0]);
    server_ = FileDescriptor(fds[1]);
    context_.limits.linger = 50ms;
  }

  /// Everything that comes back when the client sends this and then only listens.
  std::string exchange(const std::string& sent) {
    std::thread serving([this] { serveConnection(std::move(server_), context_); });
    EXPECT_TRUE(sendAll(client_.get(), sent, Clock::now() + 5s));
    ::shutdown(client_.get(), SHUT_WR);
    const std::string received = readAll();
    serving.join();
    return received;
  }

  std::string readAll() {
    std::string received;
    char bytes[4096];
    for (ssize_t count = 0; (count = ::recv(client_.get(), bytes, sizeof bytes, 0)) > 0;) {
      received.append(bytes, static_cast<std::size_t>(count));
    }
    return received;
  }

  ConnectionContext context_;
  FileDescriptor client_, server_;
};

std::size_t countOf(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++count;
  }
  return count;
}

bool has(const std::string& text, const std::string& part) {
  return countOf(text, part) > 0;
}

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
      };
      return reply;
    };
    return handler;
  };
  std::thread serving([this] { serveConnection(std::move(server_), context_); });
  EXPECT_TRUE(sendAll(client_.get(), "GET / HTTP/1.1\r\nHost: x\r\n\r\n", Clock::now() + 5s));
  char first = 0;
  EXPECT_EQ(::recv(client_.get(), &first, 1, 0), 1);
  client_.reset();
  serving.join();
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
  std::thread serving([this] { serveConnection(std::move(server_), context_); });
  EXPECT_TRUE(sendAll(client_.get(), "GET / HT", Clock::now() + 5s));
  EXPECT_TRUE(readAll().starts_with("HTTP/1.1 408 "));
  client_.reset();
  serving.join();
}

TEST_F(ConnectionTest, StopsBetweenRequests) {
  context_.limits.firstByte = 1h;
  std::thread serving([this] { serveConnection(std::move(server_), context_); });
  context_.stop.raise();
  EXPECT_EQ(readAll(), "");
  serving.join();
}

TEST_F(ConnectionTest, EndsAfterItsLastRequest) {
  context_.limits.maxRequests = 2;
  const std::string get = "GET / HTTP/1.1\r\nHost: x\r\n\r\n";
  const std::string received = exchange(get + get + get);
  EXPECT_EQ(countOf(received, "HTTP/1.1 200"), 2u);
  EXPECT_EQ(countOf(received, "Connection: close"), 1u);
}

class OverflowTest : public ConnectionTest {
 protected:
  std::string overflowed(const std::string& sent) {
    OverflowLane lane(context_);
    lane.adopt(std::move(server_));
    EXPECT_TRUE(sendAll(client_.get(), sent, Clock::now() + 5s));
    return readAll();
  }
};

TEST_F(OverflowTest, AnswersProbes) {
  EXPECT_TRUE(overflowed("GET /probe HTTP/1.1\r\nHost: x\r\n\r\n").starts_with("HTTP/1.1 200 OK"));
}

TEST_F(OverflowTest, TurnsOthersAway) {
  const std::string received = overflowed("GET /a HTTP/1.1\r\nHost: x\r\n\r\n");
  EXPECT_TRUE(received.starts_with("HTTP/1.1 503 "));
  EXPECT_TRUE(has(received, "Retry-After: 1\r\n"));
  EXPECT_TRUE(has(received, "Connection: close\r\n"));
}

TEST_F(OverflowTest, RefusesBrokenHeads) {
  EXPECT_TRUE(overflowed("nonsense\r\n\r\n").starts_with("HTTP/1.1 400 "));
}

TEST_F(OverflowTest, ASilentOneHoldsUpNobody) {
  int fds[2];
  ASSERT_EQ(::socketpair(AF_UNIX, SOCK_STREAM, 0, fds), 0);
  const FileDescriptor silent(fds[0]);
  OverflowLane lane(context_);
  lane.adopt(FileDescriptor(fds[1]));
  lane.adopt(std::move(server_));
  EXPECT_TRUE(sendAll(client_.get(), "GET /probe HTTP/1.1\r\nHost: x\r\n\r\n", Clock::now() + 5s));
  EXPECT_TRUE(readAll().starts_with("HTTP/1.1 200 OK"));
}

} // namespace
} // namespace gnomon
