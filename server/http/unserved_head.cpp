#include "server/http/unserved_head.h"

#include <utility>

namespace gnomon {

std::optional<UnservedReply> replyToUnserved(const HttpService& service, std::string_view head,
                                             const std::optional<Problem>& refusal) {
  UnservedReply told;
  RequestRecord& record = told.record;
  const auto parsed = parseRequestHead(head);
  auto request = parsed ? requestFromHead(*parsed) : Result<HttpRequest>(parsed.problems());
  if (!request) {
    record.id = requestId(parsed ? headerValue(parsed->headers, "x-request-id") : std::nullopt);
    told.reply = problemReply(request.problems(), record.id, {.read = RequestPart::head});
    return told;
  }
  record.id = request->id;
  record.trace = request->trace;
  record.method = request->method;
  record.target = parsed->target;
  told.bodyless = request->method == "HEAD";
  auto found = service(*request);
  const auto* handler = std::get_if<RequestHandler>(&found);
  record.route = handler != nullptr ? handler->route : std::get<HttpReply>(found).route;
  if (handler != nullptr && handler->isProbe) {
    told.reply = handler->answer(*std::move(request), [] { return false; });
    return told;
  }
  if (!refusal) {
    return std::nullopt;
  }
  told.reply = problemReply({*refusal}, record.id);
  told.reply.refusal = refusal->code == ProblemCode::busy ? RefusalReason::address : RefusalReason::threads;
  return told;
}

} // namespace gnomon
