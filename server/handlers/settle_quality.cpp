#include "server/handlers/settle_quality.h"

#include "protocol/json/json_codec.h"
#include "renderer/render.h"
#include "server/evaluations/evaluation_run.h"
#include "server/http/json_reply.h"

namespace gnomon {
namespace {

/// Equal for frames that one choice serves.
std::string keyOf(const std::string& sceneId, const std::string& viewClass, FrameSpec spec) {
  spec.camera = Camera{};
  return sceneId + "\n" + viewClass + "\n" + jsonText(toJson(spec));
}

/// Problems of an evaluation point into its /spec.
Problems inFrame(Problems problems) {
  constexpr std::string_view kSpec = "/spec";
  for (Problem& problem : problems) {
    if (problem.pointer.starts_with(kSpec)) {
      problem.pointer.erase(0, kSpec.size());
    }
  }
  return problems;
}

} // namespace

Result<QualityReport> settleQuality(Services& services, const RouteCall& call, const std::string& sceneId,
                                    const LoadedScene& scene, const FrameSpec& spec) {
  const auto deadline = Clock::now() + services.evaluationTimeout;
  const auto views = viewClass(*scene.scene, spec);
  if (!views) {
    return views.problems();
  }
  const std::string key = keyOf(sceneId, *views, spec);
  if (auto known = services.choices.find(key)) {
    known->cached = true;
    return *std::move(known);
  }
  auto trials = qualityTrials(spec);
  auto run = EvaluationRun::start(services, scene, qualityEvaluation(spec, trials), deadline);
  if (!run) {
    return inFrame(run.problems());
  }
  const auto measured = (*run)->report(call.clientGone);
  if (!measured) {
    return inFrame(measured.problems());
  }
  auto report = chooseTrial(*spec.quality, std::move(trials), *measured);
  if (report) {
    services.choices.keep(key, *report);
  }
  return report;
}

} // namespace gnomon
