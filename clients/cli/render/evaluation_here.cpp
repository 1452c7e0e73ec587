#include "clients/cli/render/evaluation_here.h"

#include "renderer/render.h"

namespace gnomon::cli {

void showStep(const EvaluationStep& step, Progress& progress) {
  progress.share(step.of > 0 ? static_cast<double>(step.done) / step.of : 0);
}

Result<EvaluationReport> evaluateHere(const SceneBundle& bundle, const Evaluation& evaluation,
                                      const BackendOptions& backend, Progress& progress) {
  progress.stage("loading the scene");
  const auto scene = loadScene(bundle);
  if (!scene) return scene.problems();
  progress.stage("starting the renderer");
  RendererOptions options;
  options.backend = backend;
  auto renderer = Renderer::create(options);
  if (!renderer) return renderer.problems();
  progress.stage("measuring");
  EvaluationListener listener;
  listener.step = [&](const EvaluationStep& step) {
    showStep(step, progress);
    return true;
  };
  EvaluationTools tools;
  tools.draw = [&](const FrameSpec& spec) { return renderer->render(*scene, spec, TileUse::drawnAnew); };
  tools.shimmer = [&](const FrameSpec& spec, std::span<const Camera> path,
                      const gnomon::Progress& goOn) -> Result<double> {
    const auto shimmer = renderer->shimmer(*scene, spec, path, goOn);
    if (!shimmer) return shimmer.problems();
    return shimmer->perThousand();
  };
  return evaluate(*scene, evaluation, renderer->info(), tools, listener);
}

} // namespace gnomon::cli
