#include <nlohmann/json.hpp>

#include "protocol/base/bytes.h"
#include "protocol/evaluation/evaluation.h"
#include "protocol/json/json_codec.h"
#include "renderer/core/parallel.h"
#include "server/worker/frame_memory.h"
#include "server/worker/orders.h"

namespace gnomon {
namespace {

std::string hashOf(const std::string& key) {
  Sha256 hash;
  hash.add(key);
  return hash.hex();
}

/// Equal for frames that one choice serves.
std::string keyOf(const std::string& sceneId, const std::string& viewClass, FrameSpec spec) {
  spec.camera = Camera{};
  spec.motionFrom.reset();
  return sceneId + "\n" + viewClass + "\n" + jsonText(toJson(spec));
}

/// Equal for frames of one scene in which the same would be measured.
std::string viewOf(FrameSpec spec) {
  spec.motionFrom.reset();
  return hashOf(jsonText(toJson(spec)));
}

/// The key by which a choice is stored for all servers with the same renderer and as many cores.
std::string storedKey(const std::string& sceneId, const std::string& key, const RendererInfo& renderer) {
  Sha256 hash;
  hash.add("quality 2\n" + renderer.renderer + "\n" + renderer.fingerprint + "\n" + std::to_string(coresToUse()) +
           "\n" + key);
  return sceneId + "-" + hash.hex();
}

std::optional<QualityChoice> storedChoice(LightMapStore& store, const std::string& key) {
  const auto bytes = store.read(key);
  return bytes ? readQualityChoice(asText(*bytes)) : std::nullopt;
}

void storeChoice(LightMapStore& store, const std::string& key, const QualityChoice& choice) {
  const std::string text = textOf(choice);
  store.write(key, Bytes(text.begin(), text.end()));
}

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

std::string textOf(const QualityChoice& choice) {
  return choice.view + "\n" + jsonText(toJson(choice.report));
}

std::optional<QualityChoice> readQualityChoice(std::string_view text) {
  const std::size_t line = text.find('\n');
  if (line == std::string_view::npos) return std::nullopt;
  auto report = readQualityReport(text.substr(line + 1));
  if (!report) return std::nullopt;
  return QualityChoice{std::string(text.substr(0, line)), *std::move(report)};
}

QualityReport reusedReport(QualityChoice choice, std::string_view view) {
  choice.report.cached = true;
  if (choice.view != view) choice.report.met.reset();
  return std::move(choice.report);
}

std::optional<QualityChoice> QualityChoices::find(const std::string& key) {
  const std::string hash = hashOf(key);
  const std::lock_guard lock(mutex_);
  const Entry* const found = entries_.find(hash, &Entry::hash);
  return found ? std::optional(found->choice) : std::nullopt;
}

void QualityChoices::keep(const std::string& key, const QualityChoice& choice) {
  const std::string hash = hashOf(key);
  const std::lock_guard lock(mutex_);
  entries_.eraseIf([&](const Entry& entry) { return entry.hash == hash; });
  entries_.add({hash, choice});
  entries_.keepNewest(kMost);
}

Result<EvaluationReport> evaluateScene(WorkContext& context, const LoadedScene& scene, const Evaluation& evaluation,
                                       const OrderCall& call, const EvaluationListener& listener) {
  ByteLease memory(context.frameMemory);
  const std::size_t bytes = evaluationBytes(evaluation, scene.summary, kindOf(context.renderer.info()));
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
                              },
                              context.renderer.environments()};
  auto report = evaluate(scene.scene, evaluation, context.renderer.info(), tools, watched);
  if (!report && !call.goOn()) return stoppedProblem("the evaluation", call);
  return report;
}

Result<QualityReport> settleQuality(WorkContext& context, const LoadedScene& scene, const FrameSpec& spec,
                                    const OrderCall& call) {
  const auto views = viewClass(*scene.scene, spec);
  if (!views) return views.problems();
  const std::string key = keyOf(scene.summary.id, *views, spec);
  const std::string view = viewOf(spec);
  if (auto known = context.choices.find(key)) return reusedReport(*std::move(known), view);
  const std::string stored = storedKey(scene.summary.id, key, context.renderer.info());
  if (auto known = context.stored ? storedChoice(*context.stored, stored) : std::nullopt) {
    context.choices.keep(key, *known);
    return reusedReport(*std::move(known), view);
  }
  auto report = chooseQuality(
      spec, [&](const Evaluation& evaluation) { return evaluateScene(context, scene, evaluation, call); });
  if (!report) return report;
  const QualityChoice choice{view, *report};
  context.choices.keep(key, choice);
  if (context.stored) storeChoice(*context.stored, stored, choice);
  return report;
}

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
