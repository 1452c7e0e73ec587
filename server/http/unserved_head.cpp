#include "server/http/unserved_head.h"

#include <utility>

namespace gnomon {

std::optional<UnservedReply> replyToUnserved(const HttpService& service, std::string_view head,
                                             const std::optional<Problem>& refusal) {
  UnservedReply unserved;
  RequestRecord& record = unserved.record;
  const auto parsed = parseRequestHead(head);
  auto request = parsed ? requestFromHead(*parsed) : Result<HttpRequest>(parsed.problems());
  if (!request) {
    record.id = requestId(parsed ? headerValue(parsed->headers, "x-request-id") : std::nullopt);
    unserved.reply = problemReply(request.problems(), record.id, {.read = RequestPart::head});
    return unserved;
  }
  record.id = request->id;
  record.trace = request->trace;
  record.method = request->method;
  record.target = parsed->target;
  unserved.bodyless = request->method == "HEAD";
  auto found = service(*request);
  const auto* handler = std::get_if<RequestHandler>(&found);
  record.route = handler != nullptr ? handler->route : std::get<HttpReply>(found).route;
  if (handler != nullptr && handler->isProbe) {
    unserved.reply = handler->answer(*std::move(request), [] { return false; });
    return unserved;
  }
  if (!refusal) return std::nullopt;
  unserved.reply = problemReply({*refusal}, record.id);
  unserved.reply.refusal = refusal->code == ProblemCode::busy ? RefusalReason::address : RefusalReason::threads;
  return unserved;
}

} // namespace gnomon
