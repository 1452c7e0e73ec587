#include "clients/cli/render/local_scene.h"

#include <chrono>

#include "protocol/base/elapsed.h"

namespace gnomon::cli {

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

} // namespace gnomon::cli
