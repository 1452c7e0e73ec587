#include "server/http/connection.h"

#include <atomic>
#include <future>
#include <gtest/gtest.h>
#include <memory>
#include <optional>
#include <stdexcept>
#include <sys/socket.h>
#include <thread>
#include <vector>

#include "server/http/lobby.h"
#include "server/http/reply.h"
#include "server/http/socket_io.h"

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
  ConnectionTest() : context_{echoService(), {}, ByteBudget(1 << 20), ByteBudget(1 << 20), {}} {
    int fds[2];
    EXPECT_EQ(::socketpair(AF_UNIX, SOCK_STREAM, 0, fds), 0);
    client_ = FileDescriptor(fds[0]);
    server_ = FileDescriptor(fds[1]);
    context_.limits.linger = 50ms;
  }

  /// The server's side of the pair goes to a lobby with two threads.
  std::unique_ptr<Lobby> enter() {
    auto lobby = std::make_unique<Lobby>(context_, 2, 2);
    lobby->adopt({std::move(server_), {"client", "client"}});
    return lobby;
  }

  /// Everything that comes back when the client sends this and then only listens.
  std::string exchange(const std::string& sent) {
    const auto lobby = enter();
    EXPECT_TRUE(sendAll(client_.get(), sent, Pace{}));
    ::shutdown(client_.get(), SHUT_WR);
    return readAll();
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
  const auto lobby = enter();
  EXPECT_TRUE(sendAll(client_.get(), "GET / HTTP/1.1\r\nHost: x\r\n\r\n", Pace{}));
  char first = 0;
  EXPECT_EQ(::recv(client_.get(), &first, 1, 0), 1);
  client_.reset();
  lobby->finish();
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
  const auto lobby = enter();
  EXPECT_TRUE(sendAll(client_.get(), "GET / HT", Pace{}));
  EXPECT_TRUE(readAll().starts_with("HTTP/1.1 408 "));
}

TEST_F(ConnectionTest, StopsBetweenRequests) {
  context_.limits.firstByte = 1h;
  const auto lobby = enter();
  lobby->finish();
  EXPECT_EQ(readAll(), "");
}

TEST_F(ConnectionTest, EndsAfterItsLastRequest) {
  context_.limits.maxRequests = 2;
  const std::string get = "GET / HTTP/1.1\r\nHost: x\r\n\r\n";
  const std::string received = exchange(get + get + get);
  EXPECT_EQ(countOf(received, "HTTP/1.1 200"), 2u);
  EXPECT_EQ(countOf(received, "Connection: close"), 1u);
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

  std::unique_ptr<Lobby> begin(const std::string& request) {
    auto lobby = enter();
    EXPECT_TRUE(sendAll(client_.get(), request, Pace{}));
    begun_.get_future().wait();
    return lobby;
  }

  std::promise<void> begun_;
  std::atomic<bool> left_ = false, enough_ = false;
};

TEST_F(LeavingTest, BytesThatWereSentAheadHideNothing) {
  const auto lobby = begin("GET / HTTP/1.1\r\nHost: x\r\n\r\nGET /next");
  const auto start = Clock::now();
  client_.reset();
  lobby->finish();
  EXPECT_TRUE(left_);
  EXPECT_LT(Clock::now() - start, 1s);
}

TEST_F(LeavingTest, AClientThatSendsNoMoreStillGetsItsReply) {
  const auto lobby = begin("GET / HTTP/1.1\r\nHost: x\r\n\r\n");
  ::shutdown(client_.get(), SHUT_WR);
  std::this_thread::sleep_for(50ms);
  EXPECT_FALSE(left_);
  enough_ = true;
  const std::string received = readAll();
  EXPECT_TRUE(received.starts_with("HTTP/1.1 100 Continue\r\n\r\nHTTP/1.1 200 OK\r\n")) << received;
  EXPECT_TRUE(received.ends_with("the frame"));
}

TEST_F(LeavingTest, AnOldClientIsNotSentWhatItDoesNotKnow) {
  const auto lobby = begin("GET / HTTP/1.0\r\n\r\n");
  ::shutdown(client_.get(), SHUT_WR);
  std::this_thread::sleep_for(50ms);
  enough_ = true;
  EXPECT_TRUE(readAll().starts_with("HTTP/1.1 200 OK\r\n"));
}

TEST_F(ConnectionTest, AnEmptyLineMayPrecedeARequest) {
  const std::string received = exchange(
      "\r\nGET /a HTTP/1.1\r\nHost: x\r\n\r\nPOST /b HTTP/1.1\r\nHost: x\r\nContent-Length: 2\r\n\r\nhi\r\n"
      "GET /a HTTP/1.1\r\nHost: x\r\n\r\n");
  EXPECT_EQ(countOf(received, "HTTP/1.1 200 OK\r\n"), 3u);
}

TEST_F(ConnectionTest, AnEmptyLineAfterABodyIsNoSlowRequest) {
  context_.limits.head = 20ms;
  const auto lobby = enter();
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
  const auto lobby = enter();
  EXPECT_TRUE(sendAll(client_.get(), "GET / HTTP/1.1\r\nHost: x\r\n\r\n", Pace{}));
  const auto start = Clock::now();
  EXPECT_TRUE(has(readAll(), "Connection: keep-alive\r\n"));
  EXPECT_GE(Clock::now() - start, 40ms);
}

TEST_F(ConnectionTest, IdleConnectionsHoldNoThread) {
  const auto lobby = enter(); // of two threads
  std::vector<FileDescriptor> idle;
  for (int i = 0; i < 10; ++i) {
    int fds[2];
    ASSERT_EQ(::socketpair(AF_UNIX, SOCK_STREAM, 0, fds), 0);
    idle.emplace_back(fds[0]);
    lobby->adopt({FileDescriptor(fds[1]), {"idle", "idle"}});
    ASSERT_TRUE(sendAll(fds[0], "GET / HTTP/1.1\r\nHost: x\r\n\r\n", Pace{}));
    char bytes[4096];
    ASSERT_GT(::recv(fds[0], bytes, sizeof bytes, 0), 0);
  }
  ASSERT_TRUE(sendAll(client_.get(), "GET / HTTP/1.1\r\nHost: x\r\nConnection: close\r\n\r\n", Pace{}));
  EXPECT_TRUE(readAll().starts_with("HTTP/1.1 200 OK"));
}

TEST_F(ConnectionTest, WhoWaitsMostGivesRoom) {
  context_.limits.maxWaiting = 4;
  const auto lobby = enter();
  ASSERT_TRUE(sendAll(client_.get(), "GET / HTTP/1.1\r\nHos", Pace{}));
  std::vector<FileDescriptor> many;
  for (int i = 0; i < 40; ++i) {
    int fds[2];
    ASSERT_EQ(::socketpair(AF_UNIX, SOCK_STREAM, 0, fds), 0);
    many.emplace_back(fds[0]);
    lobby->adopt({FileDescriptor(fds[1]), {"many", "many"}});
  }
  ASSERT_TRUE(sendAll(client_.get(), "t: x\r\nConnection: close\r\n\r\n", Pace{}));
  EXPECT_TRUE(readAll().starts_with("HTTP/1.1 200 OK"));
  char byte = 0;
  EXPECT_EQ(::recv(many.front().get(), &byte, 1, 0), 0) << "the first of the many is closed";
}

TEST_F(ConnectionTest, AWholeHeadIsNotDroppedForRoom) {
  context_.limits.maxWaiting = 2;
  ASSERT_TRUE(sendAll(client_.get(), "GET / HTTP/1.1\r\nHost: x\r\nConnection: close\r\n\r\n", Pace{}));
  const auto lobby = enter();
  std::vector<FileDescriptor> many;
  for (int i = 0; i < 40; ++i) {
    int fds[2];
    ASSERT_EQ(::socketpair(AF_UNIX, SOCK_STREAM, 0, fds), 0);
    many.emplace_back(fds[0]);
    lobby->adopt({FileDescriptor(fds[1]), {"client", "client"}});
  }
  EXPECT_TRUE(readAll().starts_with("HTTP/1.1 200 OK"));
}

TEST_F(ConnectionTest, AStrayByteAfterTheLastReplyDoesNotResetIt) {
  const auto lobby = enter();
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
  const auto lobby = enter();
  int fds[2];
  ASSERT_EQ(::socketpair(AF_UNIX, SOCK_STREAM, 0, fds), 0);
  const FileDescriptor taker(fds[0]);
  ASSERT_TRUE(sendAll(taker.get(), "GET / HTTP/1.1\r\nHost: x\r\n\r\n", Pace{}));
  lobby->adopt({FileDescriptor(fds[1]), {"other", "other"}});
  char byte = 0;
  ASSERT_EQ(::recv(taker.get(), &byte, 1, 0), 1);
  ASSERT_TRUE(sendAll(client_.get(), "GET / HTTP/1.1\r\nHost: x\r\nConnection: close\r\n\r\n", Pace{}));
  const std::string received = readAll();
  EXPECT_TRUE(received.starts_with("HTTP/1.1 503 "));
  EXPECT_TRUE(has(received, "Retry-After: 1\r\n"));
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
  const auto lobby = enter();
  ASSERT_TRUE(sendAll(client_.get(),
                      "POST / HTTP/1.1\r\nHost: x\r\nContent-Length: 1000\r\n\r\n" + std::string(1000, 'x'), Pace{}));
  char byte = 0;
  ASSERT_EQ(::recv(client_.get(), &byte, 1, 0), 1);
  EXPECT_TRUE(context_.bodyBytes.take(context_.bodyBytes.total()));
  client_.reset();
}

/// No thread is free: another client's request holds the only one until it is released.
class FullLobbyTest : public ConnectionTest {
 protected:
  FullLobbyTest() {
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
    lobby_.emplace(context_, 2, 1);
    lobby_->adopt({FileDescriptor(fds[1]), {"holder", "holder"}});
    EXPECT_TRUE(sendAll(holder_.get(), "GET /hold HTTP/1.1\r\nHost: x\r\n\r\n", Pace{}));
    held_.get_future().wait();
  }
  ~FullLobbyTest() override { released_.set_value(); }

  /// What a client gets; `network`: "holder" has its share of the threads already.
  std::string ask(const std::string& sent, const std::string& network) {
    lobby_->adopt({std::move(server_), {network, network}});
    EXPECT_TRUE(sendAll(client_.get(), sent, Pace{}));
    ::shutdown(client_.get(), SHUT_WR);
    return readAll();
  }

  std::promise<void> held_, released_;
  FileDescriptor holder_;
  std::optional<Lobby> lobby_;
};

TEST_F(FullLobbyTest, AnswersProbes) {
  EXPECT_TRUE(ask("GET /probe HTTP/1.1\r\nHost: x\r\n\r\n", "holder").starts_with("HTTP/1.1 200 OK"));
}

TEST_F(FullLobbyTest, AClientWithItsShareIsTurnedAway) {
  const std::string received = ask("GET /a HTTP/1.1\r\nHost: x\r\n\r\n", "holder");
  EXPECT_TRUE(received.starts_with("HTTP/1.1 429 "));
  EXPECT_TRUE(has(received, "Retry-After: 1\r\n"));
  EXPECT_TRUE(has(received, "Connection: close\r\n"));
}

TEST_F(FullLobbyTest, AnotherClientIsServed) {
  EXPECT_TRUE(ask("GET /a HTTP/1.1\r\nHost: x\r\n\r\n", "other").starts_with("HTTP/1.1 200 OK"));
}

TEST_F(FullLobbyTest, AReplyToABrokenHeadHasAnId) {
  const std::string received = ask("nonsense\r\n\r\n", "holder");
  EXPECT_TRUE(received.starts_with("HTTP/1.1 400 "));
  EXPECT_FALSE(has(received, "X-Request-ID: \r\n"));
  EXPECT_TRUE(has(received, "\"instance\""));
}

} // namespace
} // namespace gnomon
