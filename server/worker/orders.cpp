#include "server/worker/orders.h"

#include <algorithm>
#include <array>
#include <exception>
#include <new>
#include <nlohmann/json.hpp>
#include <thread>

#include "protocol/json/json_codec.h"
#include "server/system/log.h"
#include "server/worker/frame_memory.h"

namespace gnomon {
namespace {

struct OrderTraits {
  OrderKind kind;
  Answer (*carryOut)(WorkContext&, const OrderCall&);
};

constexpr std::array kOrderTraits{
    OrderTraits{OrderKind::load, loadOrder},   OrderTraits{OrderKind::frame, frameOrder},
    OrderTraits{OrderKind::plan, planOrder},   OrderTraits{OrderKind::evaluation, evaluationOrder},
    OrderTraits{OrderKind::bake, bakeOrder},   OrderTraits{OrderKind::bakeFile, bakeFileOrder},
    OrderTraits{OrderKind::nodes, nodesOrder}, OrderTraits{OrderKind::sequenceFrame, sequenceFrameOrder}};

} // namespace

Problem noMemoryFor(const Presence& order) {
  if (!order.wasAlone()) {
    return {ProblemCode::unavailable, "", "Other requests use the memory that this one needs.", "", ""};
  }
  return noMemory("", "The request needs more memory than a worker may use.");
}

Answer judgedAnswer(Answer answer, const Presence& order) {
  const bool lacksMemory = std::any_of(answer.problems.begin(), answer.problems.end(), isNoMemory);
  if (lacksMemory && !order.wasAlone()) answer.problems = {noMemoryFor(order)};
  return answer;
}

Answer carryOut(WorkContext& context, const OrderCall& call) noexcept {
  const Presence presence(context.atWork);
  try {
    return judgedAnswer(kOrderTraits[static_cast<std::size_t>(call.order.kind)].carryOut(context, call), presence);
  } catch (const std::bad_alloc&) {
    return {{noMemoryFor(presence)}};
  } catch (const std::exception& error) {
    logEvent("order", error.what(), call.order.traceId);
  } catch (...) {
    logEvent("order", "An exception of unknown type.", call.order.traceId);
  }
  return {{{ProblemCode::internal, "", "An internal error occurred.", "", ""}}};
}

std::variant<LoadedScene, Answer> sceneOf(WorkContext& context, const OrderCall& call) {
  auto loaded = context.scenes.get(call.order.scene, {call.bundle, call.order.isStored, call.order.strict}, call.goOn);
  if (auto* failure = std::get_if<LoadFailure>(&loaded)) {
    if (!call.goOn()) return Answer{.problems = {stoppedProblem("the scene", call)}};
    return Answer{.problems = std::move(failure->problems), .damaged = failure->damaged};
  }
  return std::get<LoadedScene>(std::move(loaded));
}

Problem stoppedProblem(std::string_view what, const OrderCall& call) {
  if (Clock::now() < call.deadline) {
    return {ProblemCode::unavailable, "", "The client no longer waited for " + std::string(what) + ".", "", ""};
  }
  return {ProblemCode::deadlineExceeded, "", "The deadline came before " + std::string(what) + " was done.", "", ""};
}

Status checkMemory(const ByteBudget& budget, std::size_t bytes, std::string_view pointer) {
  if (bytes <= budget.total()) return Done{};
  return Problem{ProblemCode::tooLarge, std::string(pointer),
                 "This needs more memory than a frame may take (--frame-memory-bytes).",
                 std::to_string(budget.total()) + " bytes", std::to_string(bytes) + " bytes"};
}

Status takeMemory(ByteLease& lease, const ByteBudget& budget, std::size_t bytes, std::string_view pointer,
                  const OrderCall& call) {
  constexpr std::chrono::milliseconds kNextTry{5};
  if (const Status fits = checkMemory(budget, bytes, pointer); !fits) return fits.problems();
  while (!lease.grow(bytes)) {
    if (!call.goOn()) return stoppedProblem("the memory for it", call);
    std::this_thread::sleep_for(kNextTry); // at most a few orders run in a worker
  }
  return Done{};
}

std::size_t bytesOf(const WorkContext& context, const LoadedScene& scene, const FrameSpec& spec, bool asJson) {
  const RendererInfo& info = context.renderer.info();
  const DeviceKind device = spec.device == DeviceChoice::cpu ? DeviceKind::processor : kindOf(info);
  return frameBytes(spec, scene.summary, device, asJson);
}

Answer loadOrder(WorkContext& context, const OrderCall& call) {
  auto scene = sceneOf(context, call);
  if (auto* answer = std::get_if<Answer>(&scene)) return std::move(*answer);
  return {.contentType = std::string(kJson), .body = jsonText(toJson(std::get<LoadedScene>(scene).summary))};
}

Answer nodesOrder(WorkContext& context, const OrderCall& call) {
  const auto page = readNodePage(call.request);
  if (!page) return {.problems = {{ProblemCode::internal, "", "The order names no page of nodes.", "", ""}}};
  auto scene = sceneOf(context, call);
  if (auto* answer = std::get_if<Answer>(&scene)) return std::move(*answer);
  return {.contentType = std::string(kJson),
          .body = jsonText(toJson(nodesOf(*std::get<LoadedScene>(scene).scene, *page)))};
}

Answer planOrder(WorkContext& context, const OrderCall& call) {
  const auto spec = decodeFrameSpec(call.request);
  if (!spec) return {.problems = spec.problems()};
  auto scene = sceneOf(context, call);
  if (auto* answer = std::get_if<Answer>(&scene)) return std::move(*answer);
  const std::size_t bytes = bytesOf(context, std::get<LoadedScene>(scene), *spec);
  if (const auto fits = checkMemory(context.frameMemory, bytes, "/views"); !fits) {
    return {.problems = fits.problems()};
  }
  const auto device = context.renderer.infoFor(*spec, call.goOn);
  if (!device) return {.problems = call.goOn() ? device.problems() : Problems{stoppedProblem("the plan", call)}};
  const auto plan = planFrame(std::get<LoadedScene>(scene).scene, *spec, *device);
  if (!plan) return {.problems = plan.problems()};
  return {.contentType = std::string(kJson), .body = jsonText(toJson(*plan))};
}

} // namespace gnomon
