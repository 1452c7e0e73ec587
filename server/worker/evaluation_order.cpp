#include <nlohmann/json.hpp>

#include "protocol/evaluation/evaluation_json.h"
#include "protocol/json/json_codec.h"
#include "server/worker/orders.h"

namespace gnomon {
namespace {

/// Progress and rows as events.
EvaluationListener eventListener(const OrderCall& call) {
  EvaluationListener listener;
  listener.step = [&call, reported = -1](const EvaluationStep& step) mutable {
    if (step.done != reported) call.event("progress", jsonText(toJson(step)));
    reported = step.done;
    return true;
  };
  listener.row = [&call](std::size_t, const EvaluationRow& row) { call.event("row", jsonText(toJson(row))); };
  return listener;
}

} // namespace

Answer evaluationOrder(WorkContext& context, const OrderCall& call) {
  const auto evaluation = decodeEvaluation(call.request);
  if (!evaluation) return {.problems = evaluation.problems()};
  auto loaded = sceneOf(context, call);
  if (auto* answer = std::get_if<Answer>(&loaded)) return std::move(*answer);
  const bool asEvents = call.order.mediaType == kEventStream;
  const auto report = evaluateScene(context, std::get<LoadedScene>(loaded), *evaluation, call,
                                    asEvents ? eventListener(call) : EvaluationListener{});
  if (!report) return {.problems = report.problems()};
  // The report quotes every variant, so that it may be longer than a message: the front makes an event of the body.
  if (asEvents) return {.contentType = std::string(kEventStream), .body = jsonText(toJson(*report))};
  if (call.order.mediaType == "text/csv") {
    return {.contentType = "text/csv; charset=utf-8; header=present", .body = evaluationCsv(*report)};
  }
  if (call.order.mediaType == "image/svg+xml") {
    return {.contentType = "image/svg+xml", .body = evaluationChart(*report)};
  }
  return {.contentType = std::string(kJson), .body = jsonText(toJson(*report))};
}

} // namespace gnomon
