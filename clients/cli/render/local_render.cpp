#include <chrono>
#include <nlohmann/json.hpp>

#include "clients/cli/render/rendering.h"
#include "protocol/bake/bake.h"
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

Result<LocalScene> openHere(const SceneBundle& bundle, const BackendOptions& backend, ProgressLine& progress) {
  progress.stage("loading the scene");
  const auto start = std::chrono::steady_clock::now();
  auto scene = loadScene(bundle);
  if (!scene) return scene.problems();
  const double milliseconds = millisecondsSince(start);
  progress.stage("starting the renderer");
  RendererOptions options;
  options.backend = backend;
  auto renderer = Renderer::create(options);
  if (!renderer) return renderer.problems();
  return LocalScene{*std::move(scene), *std::move(renderer), milliseconds};
}

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

Result<Baked> bakeHere(const SceneBundle& bundle, const BakeOrder& order, const BackendOptions& backend,
                       ProgressLine& progress) {
  const auto here = openHere(bundle, backend, progress);
  if (!here) return here.problems();
  const Baker baker = here->renderer.baker();
  progress.stage("baking");
  const auto report = baker.bake(here->scene, order.spec, [&](const BakeStep& step) {
    progress.share(step.of > 0 ? (step.done + step.share) / step.of : 0);
    return true;
  });
  if (!report) return report.problems();
  progress.stage("making the file");
  auto file = baker.file(here->scene, order.spec, order.kind, order.light);
  if (!file) return file.problems();
  return Baked{*std::move(file), toJson(*report).dump(2) + "\n"};
}

} // namespace gnomon::cli
