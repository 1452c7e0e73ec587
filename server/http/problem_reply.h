#pragma once

#include <string_view>

#include "protocol/base/result.h"
#include "server/http/http_reply.h"

namespace gnomon {

/// The HTTP status of a kind of problem: the only place that knows.
int statusOf(ProblemCode code);

/// All problems as application/problem+json (RFC 9457); the status is the first one's. `instance` is the request's id.
HttpReply problemReply(const Problems& problems, std::string_view instance);

/// The same under a status that only the wire has (408 431 and the like).
HttpReply problemReply(const Problems& problems, std::string_view instance, int status);

/// A busy problem whose reply says when to come again.
HttpReply busyReply(const Problems& problems, std::string_view instance, int retryAfterSeconds);

} // namespace gnomon
