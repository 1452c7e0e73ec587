#include <algorithm>
#include <nlohmann/json.hpp>

#include "protocol/bake/bake.h"
#include "protocol/json/json_codec.h"
#include "server/worker/frame_memory.h"
#include "server/worker/orders.h"

namespace gnomon {
namespace {

/// Sends progress, a few times a second and at each light.
class BakeEvents {
 public:
  explicit BakeEvents(const OrderCall& call) : call_(call) {}

  void send(const BakeStep& step) {
    constexpr std::chrono::milliseconds kPause{100};
    if (step.light == light_ && Clock::now() < sentAt_ + kPause) return;
    call_.event("progress", jsonText(toJson(step)));
    sentAt_ = Clock::now();
    light_ = step.light;
  }

 private:
  const OrderCall& call_;
  Clock::time_point sentAt_{};
  std::optional<int> light_ = -1;
};

} // namespace

Answer bakeOrder(WorkContext& context, const OrderCall& call) {
  const auto spec = decodeFrameSpec(call.request);
  if (!spec) return {.problems = spec.problems()};
  auto loaded = sceneOf(context, call);
  if (auto* answer = std::get_if<Answer>(&loaded)) return std::move(*answer);
  ByteLease memory(context.frameMemory);
  const std::size_t bytes = bakeBytes(*spec, summaryOf(*std::get<LoadedScene>(loaded).scene));
  if (auto taken = takeMemory(memory, context.frameMemory, bytes, "/shadow/lightMap", call); !taken) {
    return {.problems = taken.problems()};
  }
  const std::string key = bakeKey(call.order.scene, *spec);
  const bool asEvents = call.order.mediaType == kEventStream;
  BakeEvents events(call);
  auto report =
      context.renderer.baker().bake(std::get<LoadedScene>(loaded).scene, bakedParts(*spec), [&](BakeStep step) {
        step.key = key;
        if (asEvents) events.send(step);
        return call.goOn();
      });
  if (!report) return {.problems = call.goOn() ? report.problems() : Problems{stoppedProblem("the bake", call)}};
  report->key = key;
  if (asEvents) {
    call.event("result", jsonText(toJson(*report)));
    return {.contentType = std::string(kEventStream)};
  }
  return {.contentType = std::string(kJson), .body = jsonText(toJson(*report))};
}

Answer bakeFileOrder(WorkContext& context, const OrderCall& call) {
  constexpr std::size_t kParts = 4; ///< the map, its light in floats, the picture and its file
  const auto spec = decodeFrameSpec(call.request);
  if (!spec) return {.problems = spec.problems()};
  auto loaded = sceneOf(context, call);
  if (auto* answer = std::get_if<Answer>(&loaded)) return std::move(*answer);
  ByteLease memory(context.frameMemory);
  const std::size_t bytes =
      std::min(kParts * bakeBytes(*spec, summaryOf(*std::get<LoadedScene>(loaded).scene)), context.frameMemory.total());
  if (auto taken = takeMemory(memory, context.frameMemory, bytes, "/shadow/lightMap", call); !taken) {
    return {.problems = taken.problems()};
  }
  const auto kind = bakeFileOf(call.order.mediaType);
  if (!kind) return {.problems = {{ProblemCode::internal, "", "A bake has no such file.", "", call.order.mediaType}}};
  const auto file = context.renderer.baker().file(std::get<LoadedScene>(loaded).scene, *spec, *kind, call.order.light,
                                                  [&](const BakeStep&) { return call.goOn(); });
  if (!file) return {.problems = call.goOn() ? file.problems() : Problems{stoppedProblem("the file", call)}};
  return {.contentType = call.order.mediaType, .body = std::string(asText(*file))};
}

} // namespace gnomon
