#include "server/http/unserved_reply.h"

#include <variant>

namespace gnomon {

Result<HttpRequest> requestOf(const Result<RequestHead>& head, std::string_view bytes, RequestRecord& record) {
  record.note(head ? HeadExcerpt{head->method, head->target} : excerptOf(bytes));
  auto request = head ? requestFromHead(*head) : Result<HttpRequest>(head.problems());
  if (!request) {
    record.id = requestId(head ? headerValue(head->headers, "x-request-id") : std::nullopt);
    return request;
  }
  record.id = request->id;
  record.trace = request->trace;
  return request;
}

std::optional<UnservedReply> replyToUnserved(const HttpService& service, std::string_view head,
                                             const std::optional<Problem>& refusal) {
  UnservedReply unserved;
  RequestRecord& record = unserved.record;
  auto request = requestOf(parseRequestHead(head), head, record);
  if (!request) {
    unserved.reply = problemReply(request.problems(), record.id, {.read = RequestPart::head});
    return unserved;
  }
  unserved.bodyless = request->method == "HEAD";
  auto found = service(*request);
  const auto* handler = std::get_if<RequestHandler>(&found);
  record.route = handler != nullptr ? handler->route : std::get<HttpReply>(found).route;
  if (handler != nullptr && handler->isProbe) {
    unserved.reply = handler->answer(*std::move(request), [] { return false; });
    return unserved;
  }
  if (!refusal) return std::nullopt;
  const bool isBusy = refusal->code == ProblemCode::busy;
  unserved.reply =
      problemReply({*refusal}, record.id, {.refusal = isBusy ? RefusalReason::address : RefusalReason::threads});
  return unserved;
}

} // namespace gnomon
