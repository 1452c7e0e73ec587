#include "server/http/connection.h"

#include <exception>

#include "server/http/request_log.h"
#include "server/system/log.h"

namespace gnomon {
namespace {

/// How a connection goes on after a reply; it lingers where the client may still be sending a body that nobody reads.
enum class After { keep, close, linger };

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
    request->client = client_;
    request->arrived = record.start;
    record.id = request->id;
    record.method = request->method;
    record.target = head->target;
    const bool bodyless = request->method == "HEAD";

    auto found = context_.service(*request);
    if (auto* refused = std::get_if<HttpReply>(&found)) {
      const bool keep = mayKeep && !head->hasBody() && head->keepAlive && !context_.stop.raised();
      return send(std::move(*refused), record, keep, bodyless) && keep ? After::keep : After::linger;
    }
    const auto& handler = std::get<RequestHandler>(found);
    if (auto refused = refuseBody(*head, handler.body)) {
      send(problemReply({*std::move(refused)}, record.id, {.read = RequestPart::body}), record, false, bodyless);
      return After::linger;
    }
    ByteLease lease(context_.bodyBytes);
    if (head->hasBody()) {
      if (head->expectsContinue &&
          !sendAll(socket_.get(), "HTTP/1.1 100 Continue\r\n\r\n", Clock::now() + context_.limits.pace.stall)) {
        return After::close;
      }
      auto body = readBody(reader_, *head, handler.body, context_.limits.pace, lease);
      if (!body) {
        send(problemReply(body.problems(), record.id, {.read = RequestPart::body}), record, false, bodyless);
        return After::linger;
      }
      request->body = *std::move(body);
      record.requestBytes = request->body.size();
    }
    HttpReply reply = answer(handler, *std::move(request));
    const bool keep = mayKeep && head->keepAlive && !context_.stop.raised();
    return send(std::move(reply), record, keep, bodyless) && keep ? After::keep : After::close;
  }

  /// The next request's head; nothing where it was refused, and the client knows.
  std::optional<RequestHead> readHead(RequestRecord& record) {
    auto head = receiveHead();
    if (!head) {
      record.id = requestId(std::nullopt);
      send(problemReply(head.problems(), record.id, {.read = RequestPart::head}), record, false, false);
      return std::nullopt;
    }
    return *std::move(head);
  }

  Result<RequestHead> receiveHead() {
    const auto deadline = Clock::now() + context_.limits.head;
    while (true) {
      const auto length = headLength(reader_.buffered());
      if (length && *length <= kMaxHeadBytes) {
        auto head = parseRequestHead(reader_.buffered().substr(0, *length));
        reader_.consume(*length);
        return head;
      }
      if (reader_.buffered().size() >= kMaxHeadBytes) {
        return Problem{ProblemCode::tooLarge, "", "The request line and headers are too long.",
                       std::to_string(kMaxHeadBytes) + " bytes", ""};
      }
      const SocketWait waited = reader_.receive(4 * 1024, deadline);
      if (waited == SocketWait::timedOut) {
        return Problem{ProblemCode::deadlineExceeded, "", "The request line and headers arrived too slowly.", "", ""};
      }
      if (waited != SocketWait::ready) {
        return Problem{ProblemCode::malformed, "", "The connection ended before the headers did.", "", ""};
      }
    }
  }

  /// Nothing that a handler throws leaves it.
  HttpReply answer(const RequestHandler& handler, HttpRequest request) {
    const std::string id = request.id;
    const int fd = socket_.get();
    std::string note;
    try {
      return handler.answer(std::move(request), [fd] { return peerGone(fd); });
    } catch (const std::exception& error) {
      note = error.what();
    } catch (...) {
      note = "An exception of unknown type.";
    }
    HttpReply reply = problemReply({{ProblemCode::internal, "", "An internal error occurred.", "", ""}}, id);
    reply.note = note;
    return reply;
  }

  /// True where the whole reply was sent and the connection can serve another request.
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
        reply.note = error.what(); // its status is sent already: the body ends early
      }
    }
    logRequest(record, reply);
  }

  FileDescriptor socket_;
  const std::string client_ = peerAddress(socket_.get());
  ConnectionContext& context_;
  SocketReader reader_;
};

} // namespace

void serveConnection(FileDescriptor socket, ConnectionContext& context) noexcept {
  try {
    Connection(std::move(socket), context).serve();
  } catch (const std::exception& error) {
    logEvent("connection", error.what()); // out of memory while a head was read: the client is cut off, we go on
  }
}

} // namespace gnomon
