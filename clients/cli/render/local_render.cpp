#include <chrono>
#include <nlohmann/json.hpp>

#include "clients/cli/render/local_scene.h"
#include "clients/cli/render/rendering.h"
#include "protocol/base/elapsed.h"
#include "protocol/json/json_codec.h"
#include "renderer/render.h"

namespace gnomon::cli {
namespace {

/// A spec without a target, and how its target was met.
struct Settled {
  FrameSpec spec;
  std::optional<QualityReport> quality;
};

Result<Settled> settleTarget(const ScenePtr& scene, const FrameSpec& spec, Renderer& renderer, ProgressLine& progress) {
  if (!spec.quality) return Settled{spec, std::nullopt};
  progress.stage("finding settings");
  auto report = chooseQuality(spec, [&](const Evaluation& evaluation) {
    return evaluate(scene, evaluation, renderer.info(), evaluationTools(renderer, scene));
  });
  if (!report) return report.problems();
  FrameSpec chosen = withChoice(spec, *report);
  return Settled{std::move(chosen), std::move(*report)};
}

} // namespace

Result<Rendered> drawHere(Renderer& renderer, const ScenePtr& scene, const FrameSpec& spec,
                          std::optional<double> loadMilliseconds, ProgressLine& progress) {
  auto settled = settleTarget(scene, spec, renderer, progress);
  if (!settled) return settled.problems();
  progress.stage("rendering");
  auto frame = renderer.render(scene, settled->spec);
  if (!frame) return frame.problems();
  frame->report.quality = std::move(settled->quality);

  progress.stage("encoding");
  const auto encodeStart = std::chrono::steady_clock::now();
  auto pictures = encodePictures(*frame, frame->images.size());
  if (!pictures) return pictures.problems();
  auto& stages = frame->report.stages;
  if (loadMilliseconds) stages.insert(stages.begin(), {"load", *loadMilliseconds});
  stages.push_back({"encode", millisecondsSince(encodeStart)});
  std::vector<Picture> files;
  for (EncodedPicture& picture : *pictures) files.push_back({std::move(picture.view), std::move(picture.file)});
  return Rendered{std::move(files), toJson(frame->report).dump(2) + "\n"};
}

Result<EvaluationReport> evaluateHere(Renderer& renderer, const ScenePtr& scene, const Evaluation& evaluation,
                                      ProgressLine& progress) {
  progress.stage("measuring");
  EvaluationListener listener;
  listener.step = [&](const EvaluationStep& step) {
    progress.share(step.of > 0 ? static_cast<double>(step.done) / step.of : 0);
    return true;
  };
  return evaluate(scene, evaluation, renderer.info(), evaluationTools(renderer, scene), listener);
}

Result<EvaluationReport> evaluateHere(const SceneBundle& bundle, const Evaluation& evaluation,
                                      const BackendOptions& backend, ProgressLine& progress) {
  auto here = openHere(bundle, backend, progress);
  if (!here) return here.problems();
  return evaluateHere(here->renderer, here->scene, evaluation, progress);
}

Result<std::string> planHere(const SceneBundle& bundle, const FrameSpec& spec, const BackendOptions& backend,
                             ProgressLine& progress) {
  auto here = openHere(bundle, backend, progress);
  if (!here) return here.problems();
  progress.stage("planning");
  const auto device = here->renderer.infoFor(spec);
  if (!device) return device.problems();
  const auto plan = planFrame(here->scene, spec, *device);
  if (!plan) return plan.problems();
  return toJson(*plan).dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

} // namespace gnomon::cli
