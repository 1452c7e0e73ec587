#pragma once

#include <gtest/gtest.h>
#include <memory>
#include <stdexcept>
#include <string>
#include <sys/socket.h>
#include <vector>

#include "server/http/connection.h"
#include "server/http/pending_connections.h"
#include "server/http/reply.h"
#include "server/http/reply_sender.h"
#include "server/http/socket_io.h"

namespace gnomon {

using namespace std::chrono_literals;

/// Echoes method, path and body; "/throw" throws, "/stream" streams and then throws, "/none" takes no body, "/probe" is
/// a probe.
inline HttpReply echo(const HttpRequest& request) {
  if (request.path == std::vector<std::string>{"throw"}) {
    throw std::runtime_error("secret");
  }
  HttpReply reply;
  reply.contentType = "text/plain";
  if (request.path == std::vector<std::string>{"stream"}) {
    reply.stream = [](const BodySink& sink) -> std::shared_ptr<ReplyWait> {
      for (int i = 0; i < 3 && sink("piece "); ++i) {
      }
      throw std::runtime_error("secret");
    };
    return reply;
  }
  reply.body = request.method + " " + std::to_string(request.path.size()) + " " + std::string(asText(request.body));
  return reply;
}

inline HttpService echoService() {
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

struct SocketPair {
  SocketPair() {
    int fds[2];
    EXPECT_EQ(::socketpair(AF_UNIX, SOCK_STREAM, 0, fds), 0);
    client = FileDescriptor(fds[0]);
    server = FileDescriptor(fds[1]);
  }
  FileDescriptor client, server;
};

class ConnectionTest : public ::testing::Test {
 protected:
  ConnectionTest() : context_{echoService(), {}, ByteBudget(1 << 20), replyBytes_, {}} {
    SocketPair pair;
    client_ = std::move(pair.client);
    server_ = std::move(pair.server);
    context_.limits.linger = 50ms;
  }

  /// The server's side of the pair goes to PendingConnections with two threads.
  std::unique_ptr<PendingConnections> enter() {
    auto pending = std::make_unique<PendingConnections>(context_, 2, 2);
    pending->adopt({std::move(server_), {"client", {"client", "client"}}});
    return pending;
  }

  /// `count` more connections of one client, its ends of them.
  static std::vector<FileDescriptor> connect(PendingConnections& pending, int count, const std::string& client) {
    std::vector<FileDescriptor> clients;
    for (int i = 0; i < count; ++i) {
      SocketPair pair;
      clients.push_back(std::move(pair.client));
      pending.adopt({std::move(pair.server), {client, {client, client}}});
    }
    return clients;
  }

  /// Everything that comes back when the client sends this and then only listens.
  std::string exchange(const std::string& sent) {
    const auto pending = enter();
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

  ByteBudget replyBytes_{1 << 20};
  ConnectionContext context_;
  FileDescriptor client_, server_;
};

inline std::size_t countOf(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++count;
  }
  return count;
}

inline bool has(const std::string& text, const std::string& part) {
  return countOf(text, part) > 0;
}

} // namespace gnomon
