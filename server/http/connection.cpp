#include "server/http/connection.h"

#include <exception>
#include <iterator>
#include <memory>
#include <sys/socket.h>
#include <utility>

#include "server/http/reply_sender.h"
#include "server/http/socket_io.h"
#include "server/http/unserved_reply.h"
#include "server/http/waiting_replies.h"
#include "server/system/log.h"

namespace gnomon {
namespace {

constexpr int kStatusClientLeft = 499; ///< in the log alone: there is no client to send it to

/// Counts one more while it lives.
class Counted {
 public:
  explicit Counted(std::atomic<std::size_t>& count) : count_(count) { ++count_; }
  ~Counted() { --count_; }
  Counted(const Counted&) = delete;
  Counted& operator=(const Counted&) = delete;

 private:
  std::atomic<std::size_t>& count_;
};

class Connection {
 public:
  Connection(OpenConnection connection, ConnectionContext& context)
      : connection_(std::move(connection)),
        context_(context),
        reader_(connection_.socket.get(), std::exchange(connection_.received, {})) {}

  /// Nothing where its last reply was not sent whole.
  std::optional<OpenConnection> serve(const std::function<bool()>& mayStay) {
    bool isLast = connection_.held && !goOn(std::exchange(connection_.held, nullptr));
    while (!isLast && !connection_.held) {
      const auto length = nextHead(mayStay);
      if (!length) break;
      ++connection_.requests;
      isLast = !serveOne(*length);
      connection_.arrived = Clock::now(); // what is buffered already waited for the reply before it
    }
    if (isCut_) return std::nullopt;
    if (isLast) {
      ::shutdown(connection_.socket.get(), SHUT_WR);
      connection_.ending = true;
    } else {
      connection_.received = reader_.take();
    }
    return std::move(connection_);
  }

 private:
  /// The next head, for which a thread that is not needed elsewhere waits a moment: sooner than by way of epoll.
  std::optional<std::size_t> nextHead(const std::function<bool()>& mayStay) {
    if (reader_.buffered().empty() && mayStay()) {
      reader_.receive(kMaxHeadBytes, Clock::now() + context_.limits.stay, &context_.stop);
      connection_.arrived = Clock::now();
    }
    return headWaiting();
  }

  std::optional<std::size_t> headWaiting() const {
    const auto length = headLength(reader_.buffered());
    return length && *length <= kMaxHeadBytes ? length : std::nullopt;
  }

  /// The reply that has waited. False after the connection's last reply.
  bool goOn(std::shared_ptr<HeldReply> held) {
    const Counted counted(context_.inProgress);
    watch_ = held->watch;
    holder_ = held->holder;
    held->reply.wait = nullptr;
    if (const auto later = std::exchange(held->reply.later, nullptr)) {
      HttpReply reply = guarded(held->record.id, later);
      reply.key = std::move(held->reply.key);
      reply.client = std::move(held->reply.client);
      std::move(held->reply.headers.begin(), held->reply.headers.end(), std::back_inserter(reply.headers));
      held->reply = std::move(reply);
    }
    return deliver(std::move(held));
  }

  /// Sends a reply, unless it waits. False after the connection's last reply.
  bool deliver(std::shared_ptr<HeldReply> held) {
    bool isKept = false;
    if (held->reply.stream && !held->reply.wait) {
      held->reply.wait = sendStream(*held);
      if (!held->reply.wait) watch_->end();
    } else if (!held->reply.wait) {
      isKept = sendAnswer(std::move(held->reply), held->record, held->keepAlive, held->bodyless);
      watch_->end();
    }
    if (held->reply.wait) connection_.held = std::move(held);
    return isKept || connection_.held;
  }

  /// False after the connection's last reply.
  bool serveOne(std::size_t headBytes) {
    const Counted counted(context_.inProgress);
    RequestRecord record;
    PeerAddress client = connection_.peer; // until the head is read
    record.start = connection_.arrived;
    const std::string_view bytes = reader_.buffered().substr(0, headBytes);
    const auto head = parseRequestHead(bytes);
    auto request = requestOf(head, bytes, record);
    reader_.consume(headBytes);
    if (head) {
      client = clientAddress(connection_.peer, head->headers, context_.trustedProxies);
    }
    record.client = client.text;
    record.proxy = record.client == connection_.peer.text ? "" : connection_.peer.text;
    if (!request) {
      return send(problemReply(request.problems(), record.id, {.read = RequestPart::head}), record, false, false);
    }
    request->client = client.identity;
    holder_ = gnomon::holderOf(*request);
    request->arrived = record.start;
    const bool bodyless = request->method == "HEAD";

    auto found = context_.service(*request);
    if (auto* refused = std::get_if<HttpReply>(&found)) {
      record.route = refused->route;
      return send(std::move(*refused), record, mayKeep(*head) && !head->hasBody(), bodyless);
    }
    const auto& handler = std::get<RequestHandler>(found);
    record.route = handler.route;
    HttpReply reply;
    {
      ByteLease lease(context_.bodyBytes, holder_, static_cast<std::size_t>(head->contentLength.value_or(0)));
      if (auto problem = receiveBody(*head, handler.body, *request, lease)) {
        const bool isBusy = problem->code == ProblemCode::busy; // other bodies use the memory
        const auto refusal = isBusy ? RefusalReason::memory : RefusalReason::none;
        const ProblemReplyOptions options{RequestPart::body, context_.bodyBytes.retryAfterSeconds(), refusal};
        return send(problemReply({*problem}, record.id, options), record, false, bodyless);
      }
      record.requestBytes = request->body.size();
      watch_ = std::make_shared<ClientWatch>(connection_.socket.get(), head->isHttp11);
      reply = answer(handler, *std::move(request));
    }
    return deliver(std::make_shared<HeldReply>(std::move(reply), std::move(record), watch_, holder_, mayKeep(*head),
                                               bodyless, head->isHttp11));
  }

  bool mayKeep(const RequestHead& head) const {
    return head.keepAlive && connection_.requests < context_.limits.maxRequests && !context_.stop.raised();
  }

  std::optional<Problem> receiveBody(const RequestHead& head, const BodyRule& rule, HttpRequest& request,
                                     ByteLease& lease) {
    if (auto refused = refuseBody(head, rule, context_.bodyBytes.total())) return refused;
    if (!head.hasBody()) return std::nullopt;
    if (head.expectsContinue) {
      sendAll(connection_.socket.get(), "HTTP/1.1 100 Continue\r\n\r\n", context_.limits.pace, &context_.cutReplies);
    }
    auto body = readBody(reader_, head, rule, context_.limits.pace, lease, &context_.cutBodies);
    if (!body) return body.problems().front();
    request.body = *std::move(body);
    return std::nullopt;
  }

  HttpReply answer(const RequestHandler& handler, HttpRequest request) {
    return guarded(request.id,
                   [&] { return handler.answer(std::move(request), [watch = watch_] { return watch->left(); }); });
  }

  /// Nothing that a handler throws leaves it.
  static HttpReply guarded(const std::string& requestId, const std::function<HttpReply()>& made) {
    const std::string id = requestId;
    std::string note;
    try {
      return made();
    } catch (const std::exception& error) {
      note = error.what();
    } catch (...) {
      note = "An exception of unknown type.";
    }
    HttpReply reply = problemReply({{ProblemCode::internal, "", "An internal error occurred.", "", ""}}, id);
    reply.note = note;
    return reply;
  }

  /// For a reply beside those that other clients are taking; no longer than the server goes on. Handlers of large
  /// replies have taken it already, before they read them.
  bool awaitRoom(HttpReply& reply) {
    return reply.room.await(context_.replyBytes, holderOf(reply), reply.body.size(),
                            Clock::now() + context_.limits.replyRoom, [this] { return context_.cutBodies.raised(); });
  }

  /// Sends a handler's reply, once there is room for it beside those that other clients are taking.
  bool sendAnswer(HttpReply reply, RequestRecord& record, bool keepAlive, bool bodyless) {
    watch_->end();
    if (watch_->left()) {
      record.delivery = Delivery::clientLeft;
      reply.status = kStatusClientLeft;
      reply.problem.clear();
      context_.ended(record, reply);
      return false;
    }
    if (!bodyless && !awaitRoom(reply)) {
      const int comeAgain = context_.replyBytes.retryAfterSeconds();
      reply = problemReply({noReplyRoom()}, record.id, {RequestPart::whole, comeAgain, RefusalReason::memory});
    }
    return send(std::move(reply), record, keepAlive, bodyless);
  }

  /// True where the whole reply was sent and the connection can serve another request.
  bool send(HttpReply reply, RequestRecord& record, bool keepAlive, bool bodyless) {
    if (keepAlive) {
      const auto idle = std::chrono::floor<std::chrono::seconds>(context_.limits.idle).count();
      reply.headers.emplace_back("Keep-Alive", "timeout=" + std::to_string(idle));
    }
    addTrace(reply, record.trace);
    std::string head = replyHead(reply, record.id, keepAlive);
    const bool withBody = !bodyless && reply.status != 204 && reply.status != 304;
    constexpr std::size_t kOnePacket = 1400; // small replies leave in one piece
    if (withBody && reply.body.size() <= kOnePacket) head += reply.body;
    const bool bodyFollows = withBody && reply.body.size() > kOnePacket;
    ReplySender sender = senderOf(reply);
    sender.send(head, bodyFollows);
    if (bodyFollows) sender.send(reply.body);
    const bool isSent = sender.delivery() == Delivery::whole;
    record.replyBytes = withBody && isSent ? reply.body.size() : 0;
    sent(sender.delivery(), record, reply);
    return isSent && keepAlive;
  }

  /// For whom its bytes are held: for the key, once that is known.
  Holder holderOf(const HttpReply& reply) const {
    return {reply.client.name.empty() ? holder_.client : reply.client, holder_.request};
  }

  ReplySender senderOf(const HttpReply& reply) {
    std::vector<ByteBudget*> budgets{&context_.replyBytes};
    if (reply.memory != nullptr) budgets.push_back(reply.memory);
    return {connection_.socket.get(), TransferPace(context_.limits.pace, std::move(budgets), holderOf(reply)),
            &context_.cutReplies};
  }

  /// A client that did not take all of it is reset: it can't take what it has for a whole reply, and the kernel keeps
  /// nothing for it.
  void sent(Delivery delivery, RequestRecord& record, HttpReply& reply) {
    record.delivery = delivery;
    isCut_ = delivery != Delivery::whole;
    if (isCut_) resetWhenClosed(connection_.socket.get());
    if (delivery == Delivery::tooSlow) reply.refusal = RefusalReason::deadline;
    if (delivery == Delivery::othersWaited) reply.refusal = RefusalReason::memory;
    context_.ended(record, reply);
  }

  /// Sends what there is; what the rest waits for, or nullptr at its end, which is the connection's.
  std::shared_ptr<ReplyWait> sendStream(HeldReply& held) {
    HttpReply& reply = held.reply;
    RequestRecord& record = held.record;
    ReplySender sender = senderOf(reply);
    const auto sink = [&](std::string_view bytes) {
      const bool isSent = sender.send(bytes) == Delivery::whole;
      record.replyBytes += isSent ? bytes.size() : 0;
      return isSent;
    };
    if (!held.isBegun) {
      watch_->beginStream();
      addTrace(reply, record.trace);
      held.isBegun = true;
      sink(replyHead(reply, record.id, false));
      record.replyBytes = 0; // counts the body alone
    }
    if (sender.delivery() == Delivery::whole) {
      try {
        auto wait = reply.stream(sink);
        if (wait && sender.delivery() == Delivery::whole) return wait;
      } catch (const std::exception& error) {
        reply.note = error.what(); // its status is sent already: the body ends early
      }
    }
    held.takeResult();
    sent(sender.delivery(), record, reply);
    return nullptr;
  }

  OpenConnection connection_;
  ConnectionContext& context_;
  SocketReader reader_;
  Holder holder_;                      ///< of the request that is being answered
  bool isCut_ = false;                 ///< its reply was not sent whole
  std::shared_ptr<ClientWatch> watch_; ///< of the request that is being answered
};

} // namespace

void ConnectionContext::ended(const RequestRecord& record, const HttpReply& reply) const noexcept {
  logRequest(record, reply);
  if (observer != nullptr) observer->ended(record, reply);
}

std::optional<OpenConnection> serveConnection(OpenConnection connection, ConnectionContext& context,
                                              const std::function<bool()>& mayStay) noexcept {
  try {
    return Connection(std::move(connection), context).serve(mayStay);
  } catch (const std::exception& error) {
    logEvent("connection", error.what()); // out of memory while a head was read: the client is cut off, we go on
    return std::nullopt;
  }
}

} // namespace gnomon
