#include <nlohmann/json.hpp>

#include "protocol/base/elapsed.h"
#include "protocol/json/json_codec.h"
#include "server/worker/frame_file.h"
#include "server/worker/frame_memory.h"
#include "server/worker/orders.h"

namespace gnomon {
namespace {

/// Whether an order wants what a sensor sees instead of a frame's picture.
bool wantsSensor(const Order& order) {
  return order.depthRange.has_value() || order.labels;
}

/// That file: depths, or the colors of labels. REQUIRES: the frame has floats of view depth or materials alone.
Result<FrameFile> sensorFile(const ScenePtr& scene, Frame frame, const Order& order, const GoOn& goOn) {
  const auto start = Clock::now();
  auto file = [&]() -> Result<Bytes> {
    if (order.labels) return labelPng(*scene, frame, goOn);
    if (order.mediaType == "image/png") return depthPng(frame, *order.depthRange, goOn);
    return depthTiff(frame, *order.depthRange, goOn);
  }();
  if (!file) return std::move(file).problems();
  frame.report.stages.push_back({"encode", millisecondsSince(start)});
  return FrameFile{order.mediaType, std::string(asText(*file)), std::move(frame.report.stages),
                   std::move(frame.report.warnings)};
}

/// What the order wants of the frame.
Result<FrameFile> fileOf(Frame frame, const ScenePtr& scene, const FrameSpec& spec, const OrderCall& call) {
  const Order& order = call.order;
  if (wantsSensor(order)) return sensorFile(scene, std::move(frame), order, call.goOn);
  return frameFile(std::move(frame), spec.output.format, order.mediaType, order.boundary, call.goOn);
}

} // namespace

Answer frameOrder(WorkContext& context, const OrderCall& call) {
  auto decoded = decodeFrameSpec(call.request);
  if (!decoded) return {.problems = decoded.problems()};
  FrameSpec spec = *std::move(decoded);

  const auto start = Clock::now();
  auto loaded = sceneOf(context, call);
  if (auto* answer = std::get_if<Answer>(&loaded)) return std::move(*answer);
  const auto& scene = std::get<LoadedScene>(loaded);
  const double loadMs = millisecondsSince(start);

  std::optional<QualityReport> quality;
  if (spec.quality) {
    auto settled = settleQuality(context, scene, spec, call);
    if (!settled) return {.problems = settled.problems()};
    quality = *std::move(settled);
    spec = withChoice(spec, *quality);
  }
  ByteLease memory(context.frameMemory);
  if (auto taken = takeMemory(memory, context.frameMemory, frameBytes(spec), "/views", call); !taken) {
    return {.problems = taken.problems()};
  }
  std::optional<Result<FrameFile>> file;
  const auto drawn = context.renderer.renderAndFinish(scene.scene, spec, call.goOn, [&](DrawnFrame& frame) {
    FrameReport& report = frame.frame.report;
    report.stages.insert(
        report.stages.begin(),
        {StageTime{"queue", call.order.queuedMilliseconds + frame.queuedMilliseconds}, StageTime{"load", loadMs}});
    report.quality = quality;
    context.costs.learn(frameCost(report.spec, sceneCounts(scene.summary)), report);
    file = fileOf(std::move(frame.frame), scene.scene, spec, call);
  });
  if (!drawn) return {.problems = call.goOn() ? drawn.problems() : Problems{stoppedProblem("the frame", call)}};
  if (!*file) return {.problems = call.goOn() ? file->problems() : Problems{stoppedProblem("the frame", call)}};
  FrameFile& made = **file;
  return {.contentType = std::move(made.contentType),
          .body = std::move(made.body),
          .stages = std::move(made.stages),
          .warnings = std::move(made.warnings)};
}

} // namespace gnomon
