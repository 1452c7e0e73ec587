#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "protocol/base/result.h"
#include "protocol/json/json_codec.h"
#include "protocol/report/frame_report.h"
#include "server/system/byte_budget.h"
#include "server/system/shared_bytes.h"

namespace gnomon {

/// Why a server that works did not do what a well-formed request asked, for logs and metrics. A problem's sentence is
/// for the client.
enum class RefusalReason {
  none,
  queue,    ///< as many tasks wait as may
  threads,  ///< every thread serves a request
  address,  ///< this client's address has its share of the threads
  permits,  ///< as many evaluations or bakes run as may
  cost,     ///< the frame is more work than its time allows
  size,     ///< larger than a limit
  rate,     ///< this key has as many requests as it may have
  deadline, ///< it came too slowly, or was not done in time
  memory,   ///< bodies, replies or pictures use what there is
  storage,  ///< the store's disk is full
  keys,     ///< no key, or one that does not allow it
  origin    ///< an unknown Host, or a page of an unknown Origin
};

/// Every refusal by its name.
inline constexpr std::array<std::pair<RefusalReason, std::string_view>, 12> kRefusalNames{
    {{RefusalReason::queue, "queue"},
     {RefusalReason::threads, "threads"},
     {RefusalReason::address, "address"},
     {RefusalReason::permits, "permits"},
     {RefusalReason::cost, "cost"},
     {RefusalReason::size, "size"},
     {RefusalReason::rate, "rate"},
     {RefusalReason::deadline, "deadline"},
     {RefusalReason::memory, "memory"},
     {RefusalReason::storage, "storage"},
     {RefusalReason::keys, "keys"},
     {RefusalReason::origin, "origin"}}};

/// What a status alone means, where nothing else was noted.
inline constexpr std::array<std::pair<int, RefusalReason>, 5> kRefusalOfStatus{{{408, RefusalReason::deadline},
                                                                                {413, RefusalReason::size},
                                                                                {431, RefusalReason::size},
                                                                                {504, RefusalReason::deadline},
                                                                                {507, RefusalReason::storage}}};

constexpr RefusalReason refusalOfStatus(int status) {
  for (const auto& [known, refusal] : kRefusalOfStatus) {
    if (known == status) return refusal;
  }
  return RefusalReason::none;
}

class StopSignal;

/// Sends a piece of a body at once; false = the client is gone, and nothing more need be made.
using BodySink = std::function<bool(std::string_view)>;

/// What became of a stream, for the log and for metrics. Written before the stream ends, and read after it.
struct StreamResult {
  std::vector<StageTime> stages{};
  std::string problem{}; ///< the first problem's detail, where it ended with one
  RefusalReason refusal = RefusalReason::none;
};

/// What a reply waits for, as for news of a job, while it holds no thread. One thread looks after all such replies, so
/// that nothing here may block.
class ReplyWait {
 public:
  enum class Next {
    wait,  ///< nothing else
    end,   ///< the stream is over
    thread ///< the reply goes on with a thread
  };
  struct News {
    std::string text{}; ///< of a stream: a few kilobytes
    Next next = Next::wait;
  };

  virtual ~ReplyWait() = default;

  /// From now on raises `news`, from whatever thread, where look() may have something.
  virtual void wakeBy(const std::shared_ptr<StopSignal>& news) = 0;

  /// What there is to send since the last call. It is called then, and ten times a second besides, until there is a
  /// next step.
  virtual News look() = 0;

  /// Sent of a stream after some seconds without anything else, so that proxies keep the connection open.
  virtual std::string_view heartbeat() const { return {}; }
};

/// One reply. Content-Length, Connection, X-Request-ID, Date and the safety headers are added when it is sent.
struct HttpReply {
  int status = 200;
  std::string contentType; ///< empty = no body
  SharedBytes body;
  /// Instead of `body`: makes it while it is sent, on a thread of the connection's. The end of the connection marks its
  /// end. nullptr: it is made. Else the rest waits, and it may be called again afterwards.
  std::function<std::shared_ptr<ReplyWait>(const BodySink&)> stream;
  std::shared_ptr<ReplyWait> wait;              ///< instead of all else: `later` gives the reply, once this is over
  std::function<HttpReply()> later;             ///< headers and key of the reply that waits are added to it
  std::shared_ptr<const StreamResult> streamed; ///< of `stream`; nullptr = nothing is known of it
  std::vector<std::pair<std::string, std::string>> headers;
  bool bodyOmitted = false;      ///< HEAD whose body was not made: no Content-Length is sent
  std::vector<StageTime> stages; ///< for the log
  std::string key;               ///< for the log: the name of the key that the client has
  ClientIdentity client{};       ///< whose bytes the reply takes; without a name the one of its address
  ByteBudget* memory = nullptr;  ///< of which `stream` holds bytes until it is taken, beside those for replies
  std::string problem;           ///< for the log: the first problem's detail, as the client reads it
  std::string route;             ///< for metrics: that of RequestHandler, where the reply is a refusal of it
  RefusalReason refusal = RefusalReason::none; ///< for metrics
  std::string note;                            ///< for the log alone: an internal cause, which no client may read
  ReplyRoom room{};                            ///< for `body`, where its handler took it already
};

/// Status line and headers, with the closing empty line. Safety headers are added unless the reply has its own:
/// Content-Security-Policy default-src 'none' and X-Content-Type-Options nosniff.
std::string replyHead(const HttpReply& reply, std::string_view requestId, bool keepAlive);

HttpReply jsonReply(const Json& json, int status = 200);

/// The part of a request that was read when a problem was found. Two kinds of problem have another status before the
/// request is complete.
enum class RequestPart {
  head, ///< tooLarge is 431, deadlineExceeded is 408
  body, ///< deadlineExceeded is 408
  whole ///< tooLarge is 413, deadlineExceeded is 504
};

/// The HTTP status of a kind of problem. No other place decides one.
int statusOf(ProblemCode code, RequestPart read = RequestPart::whole);

struct ProblemReplyOptions {
  RequestPart read = RequestPart::whole;
  int retryAfterSeconds = 1;                   ///< sent with status 429 and 503; more than 1 with any
  RefusalReason refusal = RefusalReason::none; ///< for metrics
};

/// All problems as application/problem+json (RFC 9457), with the status of the first. `instance` is the request's id.
HttpReply problemReply(const Problems& problems, std::string_view instance, const ProblemReplyOptions& options = {});

/// Where a reply waited in vain for room beside those that other clients are taking.
Problem noReplyRoom();

/// One file of the web page.
struct StaticFile {
  std::string_view path;        ///< of the URL, beginning with '/'
  std::string_view contentType; ///< the whole header value
  std::string_view bytes;       ///< outlives the server
};

} // namespace gnomon
