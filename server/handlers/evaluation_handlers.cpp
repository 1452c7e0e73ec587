#include "server/handlers/evaluation_handlers.h"

#include <array>
#include <atomic>
#include <exception>
#include <thread>

#include "protocol/evaluation/evaluation_json.h"
#include "protocol/json/problem_json.h"
#include "renderer/charts/evaluation_chart.h"
#include "renderer/charts/evaluation_csv.h"
#include "server/evaluations/evaluation_run.h"
#include "server/http/ascii.h"
#include "server/http/event_stream.h"
#include "server/http/json_reply.h"
#include "server/http/negotiation.h"
#include "server/http/problem_reply.h"

namespace gnomon {
namespace {

constexpr std::array<std::string_view, 4> kForms{"application/json", "text/csv", "image/svg+xml", "text/event-stream"};
constexpr std::size_t kCsv = 1, kChart = 2, kEvents = 3;
constexpr int kRetryAfterSeconds = 10; ///< an evaluation takes a while

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
    // A chart opened by itself has its style inside, and nothing else.
    reply.headers.emplace_back("Content-Security-Policy", "default-src 'none'; style-src 'unsafe-inline'");
    return reply;
  }
  return textReply(kForms[form], jsonText(toJson(report)));
}

std::string problemText(const Problems& problems, const std::string& requestId) {
  return jsonText(problemJson(problems, statusOf(problems.front().code), requestId));
}

/// Measures, and tells everything as events.
void putEvents(EvaluationRun& run, const std::function<bool()>& gone, const std::string& requestId,
               EventStream& events) {
  int told = -1;
  EvaluationListener listener;
  listener.step = [&](const EvaluationStep& step) {
    if (step.done != told) {
      events.put("progress", jsonText(toJson(step)));
    }
    told = step.done;
    return true;
  };
  listener.row = [&](std::size_t, const EvaluationRow& row) { events.put("row", jsonText(toJson(row))); };
  try {
    const auto report = run.report(gone, listener);
    events.put(report ? "result" : "problem",
               report ? jsonText(toJson(*report)) : problemText(report.problems(), requestId));
  } catch (const std::exception&) {
    events.put("problem", problemText({{ProblemCode::internal, "", "The server made a mistake.", "", ""}}, requestId));
  }
}

HttpReply eventReply(std::shared_ptr<EvaluationRun> run, const RouteCall& call) {
  HttpReply reply;
  reply.contentType = kForms[kEvents];
  reply.headers.emplace_back("X-Accel-Buffering", "no"); // proxies that know it pass events on at once
  reply.stream = [run = std::move(run), requestId = call.request.id,
                  clientGone = call.clientGone](const BodySink& sink) {
    constexpr std::chrono::milliseconds kHeartbeat{5'000};
    EventStream events;
    std::atomic<bool> unheard = false;
    std::thread measuring([&] {
      putEvents(
          *run, [&] { return unheard || clientGone(); }, requestId, events);
      events.end();
    });
    unheard = !events.sendTo(sink, kHeartbeat);
    measuring.join();
  };
  return reply;
}

HttpReply refusal(const Problems& problems, const std::string& requestId) {
  return problems.front().code == ProblemCode::busy ? busyReply(problems, requestId, kRetryAfterSeconds)
                                                    : problemReply(problems, requestId);
}

} // namespace

HttpReply postEvaluation(Services& services, RouteCall call) {
  const auto deadline = Clock::now() + services.evaluationTimeout;
  const std::string& id = call.values.at("id");
  const std::string requestId = call.request.id;
  if (!services.store.contains(id)) {
    return problemReply({{ProblemCode::notFound, "id", "No scene with this id is stored.", "", asciiExcerpt(id)}},
                        requestId);
  }
  auto evaluation = decodeEvaluation(textOf(call.request.body));
  if (!evaluation) {
    return problemReply(evaluation.problems(), requestId);
  }
  const auto accept = headerValue(call.request.headers, "accept");
  const auto form = preferred(accept, kForms);
  if (!form) {
    return problemReply(
        {{ProblemCode::notAcceptable, "", "An evaluation can't be sent in any form that Accept names.",
          "application/json, text/csv, image/svg+xml, text/event-stream", asciiExcerpt(accept.value_or(""))}},
        requestId);
  }
  auto scene = services.store.get(id);
  if (!scene) {
    return problemReply(scene.problems(), requestId);
  }
  call.request.body = Bytes();
  auto run = EvaluationRun::start(services, *std::move(scene), *std::move(evaluation), deadline);
  if (!run) {
    return refusal(run.problems(), requestId);
  }
  HttpReply reply;
  if (*form == kEvents) {
    reply = eventReply(*std::move(run), call);
  } else {
    const auto report = (*run)->report(call.clientGone);
    if (!report) {
      return refusal(report.problems(), requestId);
    }
    reply = reportReply(*report, *form);
  }
  reply.headers.emplace_back("Cache-Control", "no-store"); // times are never the same twice
  reply.headers.emplace_back("Vary", "Accept");
  return reply;
}

} // namespace gnomon
