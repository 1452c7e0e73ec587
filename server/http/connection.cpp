#include "server/http/connection.h"

#include <exception>

#include "server/http/problem_reply.h"
#include "server/http/reply_text.h"
#include "server/http/request_id.h"
#include "server/http/request_log.h"
#include "server/http/url.h"

namespace gnomon {
namespace {

/// The end of a connection after a request that was refused before its body was read.
enum class After { keep, close, linger };

HttpReply wireReply(int status, Problem problem, const std::string& id) {
  constexpr int kRetryAfterSeconds = 1;
  return status == 429 ? busyReply({std::move(problem)}, id, kRetryAfterSeconds)
                       : problemReply({std::move(problem)}, id, status);
}

class Connection {
 public:
  Connection(FileDescriptor socket, ConnectionContext& context)
      : socket_(std::move(socket)), context_(context), reader_(socket_.get(), context.stop.fd()) {}

  void serve() {
    auto patience = context_.limits.firstByte;
    for (std::size_t count = 0; count < context_.limits.maxRequests; ++count) {
      if (reader_.await(Clock::now() + patience, true) != SocketWait::ready) {
        return;
      }
      const After after = serveOne(count + 1 < context_.limits.maxRequests);
      if (after == After::linger) {
        lingerAndClose(std::move(socket_), Clock::now() + context_.limits.linger);
      }
      if (after != After::keep) {
        return;
      }
      patience = context_.limits.idle;
    }
  }

 private:
  After serveOne(bool mayKeep) {
    RequestRecord record;
    auto head = readHead(record);
    if (!head) {
      return After::linger;
    }
    auto request = requestFromHead(*head);
    if (!request) {
      record.id = requestId(headerValue(head->headers, "x-request-id"));
      send(problemReply(request.problems(), record.id), record, false, false);
      return After::linger;
    }
    record.id = request->id;
    record.method = request->method;
    record.target = head->target;
    const bool bodyless = request->method == "HEAD";

    auto rule = context_.service.admit(*request);
    if (auto* refused = std::get_if<HttpReply>(&rule)) {
      const bool noBody = !head->chunked && head->contentLength.value_or(0) == 0;
      const bool keep = mayKeep && noBody && head->keepAlive && !context_.stop.raised();
      return send(std::move(*refused), record, keep, bodyless) && keep ? After::keep : After::linger;
    }
    if (auto refused = refuseBody(*head, std::get<BodyRule>(rule))) {
      send(wireReply(refused->status, refused->problem, record.id), record, false, bodyless);
      return After::linger;
    }
    ByteLease lease(context_.bodyBytes);
    if (head->chunked || head->contentLength.value_or(0) > 0) {
      if (head->expectsContinue &&
          !sendAll(socket_.get(), "HTTP/1.1 100 Continue\r\n\r\n", Clock::now() + context_.limits.pace.stall)) {
        return After::close;
      }
      auto body = readBody(reader_, *head, std::get<BodyRule>(rule), context_.limits.pace, lease);
      if (const auto* refused = std::get_if<BodyRefusal>(&body)) {
        send(wireReply(refused->status, refused->problem, record.id), record, false, bodyless);
        return After::linger;
      }
      request->body = std::get<Bytes>(std::move(body));
      record.requestBytes = request->body.size();
    }
    HttpReply reply = handle(*std::move(request));
    const bool keep = mayKeep && head->keepAlive && !context_.stop.raised();
    return send(std::move(reply), record, keep, bodyless) && keep ? After::keep : After::close;
  }

  std::optional<RequestHead> readHead(RequestRecord& record) {
    const auto deadline = Clock::now() + context_.limits.head;
    while (true) {
      const auto length = headLength(reader_.buffered());
      if (length && *length <= kMaxHeadBytes) {
        auto head = parseRequestHead(reader_.buffered().substr(0, *length));
        reader_.consume(*length);
        if (!head) {
          record.id = requestId(std::nullopt);
          const bool tooLarge = head.problems().front().code == ProblemCode::tooLarge;
          send(problemReply(head.problems(), record.id, tooLarge ? 431 : 400), record, false, false);
          return std::nullopt;
        }
        return *std::move(head);
      }
      Problem problem{ProblemCode::tooLarge, "", "The request line and headers are too long.",
                      std::to_string(kMaxHeadBytes) + " bytes", ""};
      int status = 431;
      if (reader_.buffered().size() < kMaxHeadBytes) {
        const SocketWait waited = reader_.receive(4 * 1024, deadline);
        if (waited == SocketWait::ready) {
          continue;
        }
        status = waited == SocketWait::timedOut ? 408 : 400;
        problem = {waited == SocketWait::timedOut ? ProblemCode::deadlineExceeded : ProblemCode::malformed, "",
                   "The request's head did not arrive.", "", ""};
      }
      record.id = requestId(std::nullopt);
      send(wireReply(status, std::move(problem), record.id), record, false, false);
      return std::nullopt;
    }
  }

  /// Nothing that a handler throws leaves it.
  HttpReply handle(HttpRequest request) {
    const std::string id = request.id;
    const int fd = socket_.get();
    std::string note;
    try {
      return context_.service.handle(std::move(request), [fd] { return peerGone(fd); });
    } catch (const std::exception& error) {
      note = error.what();
    } catch (...) {
      note = "an exception of no known type";
    }
    HttpReply reply = problemReply({{ProblemCode::internal, "", "The server made a mistake.", "", ""}}, id);
    reply.note = note;
    return reply;
  }

  /// True where the client has it all and may ask again.
  bool send(HttpReply reply, RequestRecord& record, bool keepAlive, bool bodyless) {
    if (reply.stream) {
      sendStream(reply, record);
      return false;
    }
    const auto deadline = context_.limits.pace.deadline(Clock::now(), reply.body.size());
    std::string head = replyHead(reply, record.id, keepAlive);
    const bool withBody = !bodyless && reply.status != 204 && reply.status != 304;
    constexpr std::size_t kOnePacket = 1400; // small replies leave in one piece
    if (withBody && reply.body.size() <= kOnePacket) {
      head += reply.body;
    }
    bool sent = sendAll(socket_.get(), head, deadline);
    if (sent && withBody && reply.body.size() > kOnePacket) {
      sent = sendAll(socket_.get(), reply.body, deadline);
    }
    record.delivered = sent;
    logRequest(record, reply);
    return sent;
  }

  void sendStream(HttpReply& reply, RequestRecord& record) {
    const auto sink = [&](std::string_view bytes) {
      record.delivered =
          record.delivered && sendAll(socket_.get(), bytes, context_.limits.pace.deadline(Clock::now(), bytes.size()));
      return record.delivered;
    };
    if (sink(replyHead(reply, record.id, false))) {
      try {
        reply.stream(sink);
      } catch (const std::exception& error) {
        reply.note = error.what(); // its status is sent already: the body just ends
      }
    }
    logRequest(record, reply);
  }

  FileDescriptor socket_;
  ConnectionContext& context_;
  SocketReader reader_;
};

} // namespace

Result<HttpRequest> requestFromHead(const RequestHead& head) {
  auto url = parseTarget(head.target);
  if (!url) {
    return std::move(url).problems();
  }
  HttpRequest request;
  request.id = requestId(headerValue(head.headers, "x-request-id"));
  request.method = head.method;
  request.path = std::move(url->path);
  request.query = std::move(url->query);
  request.headers = head.headers;
  return request;
}

void serveConnection(FileDescriptor socket, ConnectionContext& context) noexcept {
  try {
    Connection(std::move(socket), context).serve();
  } catch (const std::exception& error) {
    logEvent("connection", error.what()); // out of memory while a head was read: the client is cut off, we go on
  }
}

} // namespace gnomon
