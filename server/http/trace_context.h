#pragma once

#include <string>

#include "server/http/reply.h"
#include "server/http/request.h"

namespace gnomon {

/// The place of a request in a trace, for its log line and its reply. A request without a well-formed `traceparent`
/// (https://www.w3.org/TR/trace-context) begins a trace of its own.
TraceContext traceOf(const Headers& headers);

/// "00-TRACE-SPAN-FLAGS": the value of the reply's `traceresponse`, which names the span that answered.
std::string traceResponse(const TraceContext& trace);

/// Adds that header to the reply of a request that has a trace.
void addTrace(HttpReply& reply, const TraceContext& trace);

} // namespace gnomon
