#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "protocol/base/text.h"
#include "protocol/evaluation/evaluation_json.h"
#include "protocol/json/json_codec.h"
#include "server/handlers/event_reply.h"
#include "server/handlers/handlers.h"
#include "server/handlers/work.h"
#include "server/http/negotiation.h"
#include "server/http/reply.h"

namespace gnomon {
namespace {

constexpr int kEvaluationRetrySeconds = 10; ///< where the most evaluations run
constexpr std::array<std::string_view, 4> kForms{"application/json", "text/csv", "image/svg+xml", kEventStream};

/// Sends the report, which has come as the result's body, as the last event.
void tellReport(TaskResult& result, const TaskEvents& events) {
  if (auto report = bodyOf(result)) {
    events({.number = result.outcome.number, .name = "result", .data = *std::move(report)});
  }
}

} // namespace

HttpReply postEvaluation(Services& services, RouteCall call) {
  const std::string& id = call.values.at("id");
  const std::string requestId = call.request.id;
  if (const auto used = services.store.use(id); !used) return problemReply(used.problems(), requestId);
  std::string body(asText(call.request.body));
  const auto evaluation = decodeEvaluation(body);
  if (!evaluation) return problemReply(evaluation.problems(), requestId);
  const auto accept = headerValue(call.request.headers, "accept");
  const auto form = preferred(accept, kForms);
  if (!form) return problemReply({notAcceptable("An evaluation", accept, kForms)}, requestId);
  auto bundle = services.store.bundle(id);
  if (!bundle) return problemReply(bundle.problems(), requestId);
  const Permit permit = permitOf(services.evaluations);
  if (!permit) {
    HttpReply refused =
        problemReply({{ProblemCode::busy, "", "The most evaluations that may run at once are running.", "", ""}},
                     requestId, {.retryAfterSeconds = kEvaluationRetrySeconds});
    refused.refusal = RefusalReason::permits;
    return refused;
  }
  Task task = taskFor(call, OrderKind::evaluation, id, *std::move(bundle), std::move(body), services.evaluationTimeout);
  task.lane = Lane::batch;
  task.order.mediaType = kForms[*form];
  const EventedWork work = [&services, permit, task = std::move(task)](const std::function<bool()>& gone,
                                                                       const TaskEvents& events) {
    TaskResult result = runTask(services, task, gone, events);
    if (events) tellReport(result, events);
    return result;
  };
  HttpReply reply = replyAs(kForms[*form], call, work);
  if (reply.status != 200) return reply;
  if (reply.contentType == "image/svg+xml") { // a chart opened by itself needs its own style and nothing else
    reply.headers.emplace_back("Content-Security-Policy", "default-src 'none'; style-src 'unsafe-inline'");
  }
  reply.headers.emplace_back("Cache-Control", "no-store"); // measured times differ from run to run
  reply.headers.emplace_back("Vary", "Accept");
  return reply;
}

} // namespace gnomon
