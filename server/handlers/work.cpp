#include "server/handlers/work.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <nlohmann/json.hpp>

#include "protocol/base/text.h"
#include "protocol/cost/frame_cost.h"
#include "protocol/json/json_codec.h"
#include "server/handlers/event_reply.h"
#include "server/system/file_descriptor.h"
#include "server/system/numbers.h"

namespace gnomon {
namespace {

std::vector<std::string> preferences(const HttpRequest& request) {
  return splitTrimmed(headerValue(request.headers, "prefer").value_or(""), ',');
}

RefusalReason refusalOf(TaskRefusal refusal) {
  return refusal == TaskRefusal::queue    ? RefusalReason::queue
         : refusal == TaskRefusal::memory ? RefusalReason::memory
                                          : RefusalReason::none;
}

} // namespace

std::optional<int> preferredWait(const HttpRequest& request) {
  constexpr std::string_view kWait = "wait=";
  for (const std::string& preference : preferences(request)) {
    if (!preference.starts_with(kWait)) continue;
    if (const auto seconds = numberIn(std::string_view(preference).substr(kWait.size()), 1)) return seconds;
  }
  return std::nullopt;
}

bool prefersAsync(const HttpRequest& request) {
  const auto all = preferences(request);
  return std::any_of(all.begin(), all.end(),
                     [](const std::string& preference) { return lowerCase(preference) == "respond-async"; });
}

Task taskFor(const RouteCall& call, OrderKind kind, std::string sceneId, StoredBundle bundle, std::string request,
             std::chrono::milliseconds timeout) {
  Task task;
  task.order.kind = kind;
  task.order.scene = std::move(sceneId);
  task.order.isStored = bundle.isStored;
  task.bundle = std::move(bundle.file);
  task.request = std::move(request);
  task.client = call.request.client.name;
  task.order.traceId = call.request.trace.traceId;
  if (const auto seconds = preferredWait(call.request)) {
    timeout = std::min<std::chrono::milliseconds>(timeout, std::chrono::seconds(*seconds));
  }
  task.deadline = call.request.arrived + timeout;
  task.allowed = timeout;
  return task;
}

std::string secondsText(double milliseconds) {
  return std::to_string(static_cast<std::int64_t>(std::ceil(milliseconds / 1000))) + " seconds";
}

Result<Task> frameTask(const Services& services, const RouteCall& call, const std::string& scene, StoredBundle bundle,
                       const FrameSpec& spec, const SceneCounts& counts) {
  const bool hasTarget = spec.quality.has_value(); // its settings are found by drawing and measuring many frames
  const double estimate = services.workers.milliseconds(spec, counts);
  const auto allowed = static_cast<double>(services.requestTimeout.count());
  if (!hasTarget && estimate > allowed * kDoubt) {
    return Problem{ProblemCode::tooLarge, "",
                   "This frame is more work than can be done in the time of a request "
                   "(--request-timeout): fewer pixels, lights, samples, rays or volumes are less.",
                   secondsText(allowed), "about " + secondsText(estimate)};
  }
  const FrameCost cost = frameCost(spec, counts, kindOf(services.workers.info()));
  if (const double least = services.workers.leastMilliseconds(cost); !hasTarget && least >= allowed) {
    return Problem{ProblemCode::tooLarge, "",
                   "Frames of no more work were not done in the time of a request (--request-timeout), and that "
                   "twice: fewer pixels, lights, samples, rays or volumes are less.",
                   secondsText(allowed), "more than " + secondsText(least)};
  }
  Task task = taskFor(call, OrderKind::frame, scene, std::move(bundle), jsonText(toJson(spec)),
                      hasTarget ? services.evaluationTimeout : services.requestTimeout);
  const bool isLong = hasTarget || estimate > kLongFrame;
  task.lane = isLong ? Lane::batch : Lane::interactive;
  task.holdsRenderer = isLong && !hasTarget;
  if (!hasTarget && task.allowed == services.requestTimeout) task.cost = cost;
  return task;
}

void takeRoom(TaskResult& result, ByteBudget& budget, Clock::time_point deadline,
              const std::function<bool()>& unwanted) {
  if (!result.outcome.problems.empty() || !result.body) return;
  if (result.room.await(budget, sizeOf(*result.body).value_or(0), deadline, unwanted)) return;
  result.body.reset();
  result.outcome.problems = {noReplyRoom()};
  result.refusal = TaskRefusal::memory;
}

TaskResult runTask(Services& services, Task task, const std::function<bool()>& gone, const TaskEvents& events) {
  const std::string scene = task.order.scene;
  const bool hasOwnRoom = task.order.kind == OrderKind::sequenceFrame;
  const auto allowed = std::chrono::duration_cast<std::chrono::seconds>(task.allowed).count();
  TaskResult result = services.workers.run(std::move(task), gone, events);
  if (result.outcome.damaged) {
    services.store.setAside(scene);
    result.outcome.problems = {
        {ProblemCode::notFound, "id", "The stored bytes of this scene were damaged. Upload it again.", "", scene}};
  }
  for (Problem& problem : result.outcome.problems) {
    if (problem.code == ProblemCode::deadlineExceeded) problem.limit = std::to_string(allowed) + " seconds";
  }
  const auto unwanted = [&] { return gone() || (services.cut != nullptr && services.cut->raised()); };
  if (!hasOwnRoom) takeRoom(result, services.replyBytes, Clock::now() + services.replyRoom, unwanted);
  return result;
}

std::string serverTiming(const std::vector<StageTime>& stages) {
  std::string text;
  for (const StageTime& stage : stages) {
    std::array<char, 32> duration;
    const int length = std::snprintf(duration.data(), duration.size(), "%.3f", stage.milliseconds);
    text += (text.empty() ? "" : ", ") + stage.stage + ";dur=";
    text.append(duration.data(), static_cast<std::size_t>(length));
  }
  return text;
}

std::string warningsField(const std::vector<std::string>& warnings) {
  const auto text = [](const Json& list) { return list.dump(-1, ' ', true, Json::error_handler_t::replace); };
  Json list = Json::array();
  for (std::size_t i = 0; i < warnings.size(); ++i) {
    list.push_back(warnings[i]);
    if (text(list).size() <= kMostWarningBytes) continue;
    list.back() = std::to_string(warnings.size() - i) + " more warnings are in the frame's report.";
    break;
  }
  return text(list);
}

std::optional<std::string> bodyOf(TaskResult& result) {
  Problems& problems = result.outcome.problems;
  if (!problems.empty()) return std::nullopt;
  auto body = result.body ? readText(*result.body, std::numeric_limits<std::int32_t>::max()) : std::nullopt;
  if (!body) problems = {{ProblemCode::internal, "", "The worker's reply could not be read.", "", ""}};
  return body;
}

HttpReply replyOf(TaskResult result, std::string_view requestId) {
  Outcome& outcome = result.outcome;
  auto body = bodyOf(result);
  if (!outcome.problems.empty()) {
    HttpReply reply = problemReply(outcome.problems, requestId, {.retryAfterSeconds = outcome.retryAfterSeconds});
    reply.note = std::move(outcome.note);
    reply.refusal = refusalOf(result.refusal);
    return reply;
  }
  HttpReply reply;
  reply.contentType = std::move(outcome.contentType);
  reply.body = *std::move(body);
  reply.room = std::move(result.room);
  reply.stages = std::move(outcome.stages);
  if (!reply.stages.empty()) {
    reply.headers.emplace_back("Server-Timing", serverTiming(reply.stages));
    reply.headers.emplace_back("Timing-Allow-Origin", "*");
  }
  if (!outcome.warnings.empty()) reply.headers.emplace_back("Gnomon-Warnings", warningsField(outcome.warnings));
  return reply;
}

HttpReply loadScene(Services& services, const RouteCall& call, const std::string& id, StoredBundle bundle,
                    bool strict) {
  Task task = taskFor(call, OrderKind::load, id, std::move(bundle), "", services.requestTimeout);
  task.lane = Lane::load;
  task.order.strict = strict;
  return replyOf(runTask(services, std::move(task), call.clientGone), call.request.id);
}

HttpReply replyAs(std::string_view mediaType, const RouteCall& call, EventedWork work) {
  if (mediaType != kEventStream) return replyOf(work(call.clientGone, {}), call.request.id);
  return eventReply(call, [work = std::move(work), requestId = call.request.id](const std::function<bool()>& gone,
                                                                                EventStream& events) {
    const TaskResult result = work(gone, [&](const OrderEvent& event) { events.put(event.name, event.data); });
    StreamResult ended{.stages = result.outcome.stages, .refusal = refusalOf(result.refusal)};
    if (!result.outcome.problems.empty()) {
      const Problem& first = result.outcome.problems.front();
      ended.problem = first.detail;
      if (ended.refusal == RefusalReason::none) ended.refusal = refusalOfStatus(statusOf(first.code));
      events.put("problem", problemText(result.outcome.problems, requestId));
    }
    return ended;
  });
}

Permit permitOf(std::counting_semaphore<>& permits) {
  if (!permits.try_acquire()) return nullptr;
  return {&permits, [](std::counting_semaphore<>* taken) { taken->release(); }};
}

} // namespace gnomon
