#pragma once

#include <optional>
#include <string_view>

#include "server/http/connection.h"

namespace gnomon {

/// The request of a head, and what the record has of it. `bytes`: of the head, for one that is malformed.
Result<HttpRequest> requestOf(const Result<RequestHead>& head, std::string_view bytes, RequestRecord& record);

/// The reply to a request that no thread serves, as it is sent and logged.
struct UnservedReply {
  HttpReply reply;
  RequestRecord record; ///< without its client and its start
  bool bodyless = false;
};

/// What can be said to a complete head without a thread: a probe is answered, a malformed head refused, and anything
/// else refused with `refusal`. Nothing where there is none: the request may go on waiting.
std::optional<UnservedReply> replyToUnserved(const HttpService& service, std::string_view head,
                                             const std::optional<Problem>& refusal);

} // namespace gnomon
