#include <nlohmann/json.hpp>

#include "protocol/base/bytes.h"
#include "protocol/json/json_codec.h"
#include "protocol/json/quality_json.h"
#include "renderer/core/parallel.h"
#include "server/worker/frame_memory.h"
#include "server/worker/orders.h"

namespace gnomon {
namespace {

/// Equal for frames that one choice serves.
std::string keyOf(const std::string& sceneId, const std::string& viewClass, FrameSpec spec) {
  spec.camera = Camera{};
  spec.motionFrom.reset();
  return sceneId + "\n" + viewClass + "\n" + jsonText(toJson(spec));
}

/// The key by which a choice is stored for all servers with the same renderer and as many cores.
std::string storedKey(const std::string& sceneId, const std::string& key, const RendererInfo& renderer) {
  Sha256 hash;
  hash.add("quality\n" + renderer.renderer + "\n" + renderer.fingerprint + "\n" + std::to_string(coresToUse()) + "\n" +
           key);
  return sceneId + "-" + hash.hex();
}

std::optional<QualityReport> storedChoice(LightMapStore& store, const std::string& key) {
  const auto bytes = store.read(key);
  return bytes ? readQualityReport(asText(*bytes)) : std::nullopt;
}

void storeChoice(LightMapStore& store, const std::string& key, const QualityReport& report) {
  const std::string text = jsonText(toJson(report));
  store.write(key, Bytes(text.begin(), text.end()));
}

} // namespace

Result<EvaluationReport> evaluateScene(WorkContext& context, const LoadedScene& scene, const Evaluation& evaluation,
                                       const OrderCall& call, const EvaluationListener& listener) {
  ByteLease memory(context.frameMemory);
  const std::size_t bytes = evaluationBytes(evaluation, scene.summary.lights.size());
  if (auto taken = takeMemory(memory, context.frameMemory, bytes, "/spec/width", call); !taken) {
    return std::move(taken).problems();
  }
  EvaluationListener watched = listener;
  watched.step = [&](const EvaluationStep& step) { return call.goOn() && (!listener.step || listener.step(step)); };
  const EvaluationTools tools{[&](const FrameSpec& spec) -> Result<Frame> {
                                auto drawn = context.renderer.render(scene.scene, spec, TileUse::drawnAnew, call.goOn);
                                if (!drawn) return std::move(drawn).problems();
                                return std::move(drawn->frame);
                              },
                              [&](const FrameSpec& spec, std::span<const Camera> path, const Progress&) {
                                return context.renderer.shimmer(scene.scene, spec, path, call.goOn);
                              }};
  auto report = evaluate(scene.scene, evaluation, context.renderer.info(), tools, watched);
  if (!report && !call.goOn()) return stoppedProblem("the evaluation", call);
  return report;
}

Result<QualityReport> settleQuality(WorkContext& context, const LoadedScene& scene, const FrameSpec& spec,
                                    const OrderCall& call) {
  const auto views = viewClass(*scene.scene, spec);
  if (!views) return views.problems();
  const std::string key = keyOf(scene.summary.id, *views, spec);
  if (auto known = context.choices.find(key)) {
    known->cached = true;
    return *std::move(known);
  }
  const std::string stored = storedKey(scene.summary.id, key, context.renderer.info());
  if (auto known = context.stored ? storedChoice(*context.stored, stored) : std::nullopt) {
    context.choices.keep(key, *known);
    known->cached = true;
    return *std::move(known);
  }
  auto report = chooseQuality(
      spec, [&](const Evaluation& evaluation) { return evaluateScene(context, scene, evaluation, call); });
  if (report) context.choices.keep(key, *report);
  if (report && context.stored) storeChoice(*context.stored, stored, *report);
  return report;
}

} // namespace gnomon
