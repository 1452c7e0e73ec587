#pragma once

#include <string>

#include "server/http/reply.h"
#include "server/http/reply_sender.h"
#include "server/http/request.h"
#include "server/system/clock.h"

namespace gnomon {

/// What the log says of a request, apart from its reply.
struct RequestRecord {
  std::string id;
  std::string client;  ///< its address
  std::string proxy{}; ///< that of the proxy in between; empty = there is none that is trusted
  TraceContext trace{};
  std::string method;
  std::string target;  ///< as it came; in the log shortened, and without a signature
  std::string route{}; ///< RequestHandler::route; empty = none was found
  std::size_t requestBytes = 0;
  std::size_t replyBytes = 0; ///< of its body, as far as it was sent
  Delivery delivery = Delivery::whole;
  Clock::time_point start = Clock::now();

  void note(HeadExcerpt excerpt) {
    method = std::move(excerpt.method);
    target = std::move(excerpt.target);
  }
};

/// The line's text: one JSON object, no scene contents.
std::string requestLine(const RequestRecord& record, const HttpReply& reply, double milliseconds);

/// Writes the line to the log. Never throws, never waits.
void logRequest(const RequestRecord& record, const HttpReply& reply) noexcept;

/// The place of a request in a trace, for its log line and its reply. A request without a well-formed `traceparent`
/// (https://www.w3.org/TR/trace-context) begins a trace of its own.
TraceContext traceOf(const Headers& headers);

/// "00-TRACE-SPAN-FLAGS": the value of the reply's `traceresponse`, which names the span that answered.
std::string traceResponse(const TraceContext& trace);

/// Adds that header to the reply of a request that has a trace.
void addTrace(HttpReply& reply, const TraceContext& trace);

} // namespace gnomon
