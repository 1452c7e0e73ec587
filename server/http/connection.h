#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string_view>
#include <variant>

#include "protocol/access/access_key.h"
#include "server/http/client_address.h"
#include "server/http/reply.h"
#include "server/http/request_body.h"
#include "server/http/request_log.h"
#include "server/system/lasting.h"

namespace gnomon {

/// Answers one request, without access to its socket.
struct RequestHandler {
  BodyRule body;
  Scope scope = Scope::none;   ///< what a key must allow, where the server has keys
  bool takesSignature = false; ///< a signed address does instead of a key (access_key.h)
  std::string route{};         ///< its name for metrics: one of a fixed few, whatever clients send
  bool isProbe = false;        ///< answered however busy everything else is: it reads a few atomics and returns

  /// The reply. `clientGone` may be called at any time, by any thread that the handler waits for.
  std::function<HttpReply(HttpRequest, const std::function<bool()>& clientGone)> answer;
};

/// Finds the handler of a request by its head alone, or gives the reply that refuses it. Many threads at once.
using HttpService = std::function<std::variant<RequestHandler, HttpReply>(const HttpRequest&)>;

/// How long a client may take, and how much it may ask for.
struct ConnectionLimits {
  std::chrono::milliseconds firstByte{5'000}; ///< from connecting to the first byte
  std::chrono::milliseconds head{5'000};      ///< from the first byte of a request to the end of its head, in all
  std::chrono::milliseconds idle{75'000};     ///< between two requests
  std::chrono::milliseconds linger{2'000};    ///< for what a client still sends after its last reply
  std::chrono::milliseconds replyRoom{5'000}; ///< for other replies to be taken where they use all the memory
  Pace pace;                                  ///< bodies, both ways
  std::chrono::milliseconds threadWait{100};  ///< for a thread, once the head is complete
  std::chrono::milliseconds look{100};        ///< between two looks at a reply that waits, without news of it
  std::chrono::milliseconds stay{2};          ///< of a thread with a client that may ask again at once
  std::size_t maxRequests = 10'000;
  std::size_t maxWaiting = 2'048; ///< connections that have no request to serve
};

/// Called for each request as it ends, on the thread that served it.
class RequestObserver {
 public:
  virtual ~RequestObserver() = default;
  virtual void ended(const RequestRecord& record, const HttpReply& reply) noexcept = 0;
};

/// What all connections of a server share. Outlives them.
struct ConnectionContext {
  HttpService service;
  ConnectionLimits limits;
  ByteBudget bodyBytes;                    ///< bodies that are read, or that their handlers work on
  ByteBudget& replyBytes;                  ///< bodies of replies that are being sent; one alone may be larger
  StopSignal stop;                         ///< once raised: no further request is read, the running one is answered
  StopSignal cutBodies{};                  ///< once raised: what is still to come of requests is not waited for: 503
  StopSignal cutReplies{};                 ///< once raised: no client that takes a reply is waited for
  std::vector<IpNetwork> trustedProxies{}; ///< whose X-Forwarded-For is trusted
  RequestObserver* observer = nullptr;     ///< outlives the context; nullptr = none
  std::atomic<std::size_t> inProgress{0};  ///< requests that have a thread
  Lasting lackingThreads{};                ///< requests that come find none

  /// A request's end: its line in the log, and the observer's.
  void ended(const RequestRecord& record, const HttpReply& reply) const noexcept;
};

/// Answers the requests whose heads have come whole. What comes back waits for the next one, or is ending; nothing
/// where the connection is lost. Throws nothing.
/// `mayStay`: whether the thread may wait a moment for the next request, since no other connection wants it.
std::optional<OpenConnection> serveConnection(OpenConnection connection, ConnectionContext& context,
                                              const std::function<bool()>& mayStay) noexcept;

} // namespace gnomon
