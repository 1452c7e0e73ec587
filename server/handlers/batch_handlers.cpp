#include <array>
#include <nlohmann/json.hpp>

#include "protocol/bake/bake.h"
#include "protocol/base/text.h"
#include "protocol/evaluation/evaluation.h"
#include "protocol/json/json_codec.h"
#include "protocol/spec/debug_light.h"
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
    events({.number = result.outcome.number, .name = "result", .data = std::string(*report)});
  }
}

constexpr std::array<std::string_view, 2> kReportForms{"application/json", kEventStream};
constexpr int kBakeRetrySeconds = 5; ///< where the most bakes run

Problem unknownBake(const BakeName& name) {
  return {ProblemCode::notFound, "key", "No bake with this key is done.", "", asciiExcerpt(name.key)};
}

/// As bakeFile takes it.
Result<std::optional<int>> bakedLightOf(const Query& query, int lights) {
  if (queryText(query, "light") == std::string_view(kEnvironmentName)) return std::optional(kEnvironmentLight);
  return queryNumber(query, "light", 0, lights - 1, "This is no index of a light, nor environment.");
}

BakeName nameOf(const RouteCall& call) {
  return {call.values.at("id"), call.values.at("key")};
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
    return problemReply({{ProblemCode::busy, "", "The most evaluations that may run at once are running.", "", ""}},
                        requestId, {.retryAfterSeconds = kEvaluationRetrySeconds, .refusal = RefusalReason::permits});
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

HttpReply postBake(Services& services, RouteCall call) {
  const std::string& id = call.values.at("id");
  const std::string requestId = call.request.id;
  if (const auto used = services.store.use(id); !used) return problemReply(used.problems(), requestId);
  const auto spec = decodeFrameSpec(asText(call.request.body));
  if (!spec) return problemReply(spec.problems(), requestId);
  const auto accept = headerValue(call.request.headers, "accept");
  const auto form = preferred(accept, kReportForms);
  if (!form) return problemReply({notAcceptable("A bake's progress", accept, kReportForms)}, requestId);
  auto bundle = services.store.bundle(id);
  if (!bundle) return problemReply(bundle.problems(), requestId);
  const Permit permit = permitOf(services.bakes);
  if (!permit) {
    return problemReply({{ProblemCode::busy, "", "The most bakes that may run at once are running.", "", ""}},
                        requestId, {.retryAfterSeconds = kBakeRetrySeconds, .refusal = RefusalReason::permits});
  }
  Task task =
      taskFor(call, OrderKind::bake, id, *std::move(bundle), jsonText(toJson(*spec)), services.evaluationTimeout);
  task.lane = Lane::batch;
  task.order.mediaType = kReportForms[*form];
  const EventedWork work = [&services, permit, task = std::move(task), name = BakeName{id, bakeKey(id, *spec)},
                            spec = bakedParts(*spec)](const std::function<bool()>& gone, const TaskEvents& events) {
    const auto removed = services.bakeBook.begin(name, spec);
    const auto onEvent = [&](const OrderEvent& event) {
      if (event.name == "result")
        services.bakeBook.end(name, true); // a client that reads it may ask for the file at once
      if (events) events(event);
    };
    TaskResult result = runTask(
        services, task, [&] { return *removed || gone(); }, onEvent);
    services.bakeBook.end(name, result.outcome.problems.empty());
    return result;
  };
  HttpReply reply = replyAs(kReportForms[*form], call, work);
  if (reply.status != 200) return reply;
  reply.headers.emplace_back("Cache-Control", "no-store"); // says whether the maps were there already
  reply.headers.emplace_back("Vary", "Accept");
  return reply;
}

HttpReply getBake(Services& services, RouteCall call) {
  const std::string requestId = call.request.id;
  const BakeName name = nameOf(call);
  if (const auto there = services.store.contains(name.scene); !there) return problemReply(there.problems(), requestId);
  const auto spec = services.bakeBook.find(name);
  if (!spec) return problemReply({unknownBake(name)}, requestId);
  const auto light = bakedLightOf(call.request.query, services.limits.maxLights);
  if (!light) return problemReply(light.problems(), requestId);
  const auto accept = headerValue(call.request.headers, "accept");
  const auto form = preferred(accept, kBakeFileTypes);
  if (!form) return problemReply({notAcceptable("A bake", accept, kBakeFileTypes)}, requestId);
  auto bundle = services.store.bundle(name.scene);
  if (!bundle) return problemReply(bundle.problems(), requestId);
  Task task = taskFor(call, OrderKind::bakeFile, name.scene, *std::move(bundle), jsonText(toJson(*spec)),
                      services.evaluationTimeout);
  task.lane = Lane::batch;
  task.order.mediaType = kBakeFileTypes[*form];
  task.order.light = *light;
  HttpReply reply = replyOf(runTask(services, std::move(task), call.clientGone), requestId);
  if (reply.status != 200) return reply;
  reply.headers.emplace_back("Cache-Control", "private, no-cache");
  reply.headers.emplace_back("Vary", "Accept");
  return reply;
}

HttpReply deleteBake(Services& services, RouteCall call) {
  const BakeName name = nameOf(call);
  if (!services.bakeBook.remove(name)) {
    return problemReply(
        {{ProblemCode::notFound, "key", "No bake with this key is in progress or done.", "", asciiExcerpt(name.key)}},
        call.request.id);
  }
  HttpReply reply;
  reply.status = 204;
  return reply;
}

} // namespace gnomon
