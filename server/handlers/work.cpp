#include "server/handlers/work.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "protocol/base/text.h"
#include "protocol/cost/frame_cost.h"
#include "protocol/json/json_codec.h"
#include "server/handlers/event_reply.h"
#include "server/system/file_descriptor.h"
#include "server/system/log.h"
#include "server/system/numbers.h"

namespace gnomon {
namespace {

std::vector<std::string> preferences(const HttpRequest& request) {
  return splitTrimmed(headerValue(request.headers, "prefer").value_or(""), ',');
}

/// Whether these are the bytes that the scene's id names: no worker's word alone removes a scene.
bool isBundleOf(const FileDescriptor& bundle, const std::string& scene) {
  Sha256 hash;
  return eachPiece(bundle, [&](std::span<const std::uint8_t> piece) { hash.add(asText(piece)); }) &&
         hash.hex() == scene;
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
  task.client = call.request.client;
  task.holder = holderOf(call.request);
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
  // What is estimated to be far less than the deadline is late for another reason: a machine that is overloaded.
  const bool mayBeLate = estimate * kDoubt * kDoubt >= allowed;
  if (!hasTarget && mayBeLate && task.allowed == services.requestTimeout) task.cost = cost;
  return task;
}

void takeRoom(TaskResult& result, ByteBudget& budget, const Holder& holder, Clock::time_point deadline,
              const std::function<bool()>& unwanted) {
  if (!result.outcome.problems.empty() || !result.body) return;
  if (result.room.await(budget, holder, result.body->size(), deadline, unwanted)) return;
  result.body.reset();
  result.outcome.problems = {noReplyRoom()};
  result.outcome.retryAfterSeconds = budget.retryAfterSeconds();
  result.refusal = TaskRefusal::memory;
}

TaskResult runTask(Services& services, Task task, const std::function<bool()>& gone, const TaskEvents& events) {
  const std::string scene = task.order.scene;
  const Holder holder = task.holder;
  const bool hasOwnRoom = task.order.kind == OrderKind::sequenceFrame;
  const auto allowed = std::chrono::duration_cast<std::chrono::seconds>(task.allowed).count();
  const auto bundle = task.bundle;
  TaskResult result = services.workers.run(std::move(task), gone, events);
  if (result.outcome.damaged && isBundleOf(*bundle, scene)) {
    logEvent("worker", "A worker called scene " + scene + " damaged, whose stored bytes are its own.");
    result.outcome.problems = {{ProblemCode::internal, "", "The scene's bytes could not be read.", "", ""}};
  } else if (result.outcome.damaged) {
    services.store.setAside(scene);
    result.outcome.problems = {
        {ProblemCode::notFound, "id", "The stored bytes of this scene were damaged. Upload it again.", "", scene}};
  }
  for (Problem& problem : result.outcome.problems) {
    if (problem.code == ProblemCode::deadlineExceeded) problem.limit = std::to_string(allowed) + " seconds";
  }
  const auto unwanted = [&] { return gone() || (services.cut != nullptr && services.cut->raised()); };
  if (!hasOwnRoom) takeRoom(result, services.replyBytes, holder, Clock::now() + services.replyRoom, unwanted);
  return result;
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
