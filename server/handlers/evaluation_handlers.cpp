#include <array>
#include <nlohmann/json.hpp>

#include "protocol/base/text.h"
#include "protocol/evaluation/evaluation_json.h"
#include "protocol/json/json_codec.h"
#include "renderer/charts/evaluation_chart.h"
#include "renderer/charts/evaluation_csv.h"
#include "server/evaluations/evaluation_run.h"
#include "server/handlers/event_reply.h"
#include "server/handlers/handlers.h"
#include "server/http/negotiation.h"
#include "server/http/reply.h"

namespace gnomon {
namespace {

constexpr std::array<std::string_view, 4> kForms{"application/json", "text/csv", "image/svg+xml", kEventStream};
constexpr std::size_t kCsv = 1, kChart = 2, kEvents = 3;

HttpReply textReply(std::string_view contentType, std::string body) {
  HttpReply reply;
  reply.contentType = contentType;
  reply.body = std::move(body);
  return reply;
}

HttpReply reportReply(const EvaluationReport& report, std::size_t form) {
  if (form == kCsv) {
    return textReply("text/csv; charset=utf-8; header=present", evaluationCsv(report));
  }
  if (form == kChart) {
    HttpReply reply = textReply(kForms[form], evaluationChart(report));
    // A chart opened by itself needs its own style and nothing else.
    reply.headers.emplace_back("Content-Security-Policy", "default-src 'none'; style-src 'unsafe-inline'");
    return reply;
  }
  return textReply(kForms[form], jsonText(toJson(report)));
}

/// Measures, and puts progress, rows and the result as events.
void putEvents(EvaluationRun& run, const std::function<bool()>& gone, const std::string& requestId,
               EventStream& events) {
  int reported = -1;
  EvaluationListener listener;
  listener.step = [&](const EvaluationStep& step) {
    if (step.done != reported) {
      events.put("progress", jsonText(toJson(step)));
    }
    reported = step.done;
    return true;
  };
  listener.row = [&](std::size_t, const EvaluationRow& row) { events.put("row", jsonText(toJson(row))); };
  const auto report = run.report(gone, listener);
  events.put(report ? "result" : "problem",
             report ? jsonText(toJson(*report)) : problemText(report.problems(), requestId));
}

} // namespace

HttpReply postEvaluation(Services& services, RouteCall call) {
  const auto deadline = Clock::now() + services.evaluations.timeout;
  const std::string& id = call.values.at("id");
  const std::string requestId = call.request.id;
  if (!services.store.contains(id)) {
    return problemReply({unknownScene(id)}, requestId);
  }
  auto evaluation = decodeEvaluation(asText(call.request.body));
  if (!evaluation) {
    return problemReply(evaluation.problems(), requestId);
  }
  const auto accept = headerValue(call.request.headers, "accept");
  const auto form = preferred(accept, kForms);
  if (!form) {
    return problemReply(
        {{ProblemCode::notAcceptable, "", "An evaluation can't be sent as any media type that Accept lists.",
          "application/json, text/csv, image/svg+xml, text/event-stream", asciiExcerpt(accept.value_or(""))}},
        requestId);
  }
  auto scene = services.store.get(id);
  if (!scene) {
    return problemReply(scene.problems(), requestId);
  }
  call.request.body = Bytes();
  auto run = EvaluationRun::start(services.evaluations, *std::move(scene), *std::move(evaluation), deadline);
  if (!run) {
    return problemReply(run.problems(), requestId, {.retryAfterSeconds = kEvaluationRetrySeconds});
  }
  HttpReply reply;
  if (*form == kEvents) {
    reply =
        eventReply(call, [run = *std::move(run), requestId](const std::function<bool()>& gone, EventStream& events) {
          putEvents(*run, gone, requestId, events);
        });
  } else {
    const auto report = (*run)->report(call.clientGone);
    if (!report) {
      return problemReply(report.problems(), requestId, {.retryAfterSeconds = kEvaluationRetrySeconds});
    }
    reply = reportReply(*report, *form);
  }
  reply.headers.emplace_back("Cache-Control", "no-store"); // measured times differ from run to run
  reply.headers.emplace_back("Vary", "Accept");
  return reply;
}

} // namespace gnomon
