#include "clients/cli/render/frame_maker.h"

#include <chrono>
#include <utility>

#include "protocol/base/elapsed.h"
#include "protocol/evaluation/evaluation.h"

namespace gnomon::cli {

Status FrameMaker::open(SceneBundle bundle, ProgressLine& progress) {
  if (!isOnServer()) return load(bundle, progress);
  bundle_ = std::move(bundle);
  id_.clear();
  return Done{};
}

void FrameMaker::openStored(std::string id) {
  bundle_ = {};
  id_ = std::move(id);
}

Status FrameMaker::load(const SceneBundle& bundle, ProgressLine& progress) {
  progress.stage("loading the scene");
  const auto start = std::chrono::steady_clock::now();
  scene_ = nullptr; // the one before goes first: both need not fit into the memory
  auto scene = loadScene(bundle);
  if (!scene) return scene.problems();
  loadMilliseconds_ = millisecondsSince(start);
  if (!renderer_) {
    progress.stage("starting the renderer");
    RendererOptions options;
    options.backend = std::get<BackendOptions>(where_);
    auto renderer = Renderer::create(options);
    if (!renderer) return renderer.problems();
    renderer_.emplace(*std::move(renderer));
  }
  scene_ = *std::move(scene);
  return Done{};
}

Result<Rendered> FrameMaker::draw(const FrameSpec& spec, ProgressLine& progress) {
  if (const auto* remote = std::get_if<Remote>(&where_)) return drawThere(*remote, bundle_, id_, spec, progress);
  return drawHere(*renderer_, scene_, spec, std::exchange(loadMilliseconds_, std::nullopt), progress);
}

Result<EvaluationReport> FrameMaker::measure(const std::string& requestJson, ProgressLine& progress) {
  if (const auto* remote = std::get_if<Remote>(&where_)) {
    return evaluateThere(*remote, bundle_, id_, requestJson, progress);
  }
  const auto evaluation = decodeEvaluation(requestJson);
  if (!evaluation) return evaluation.problems();
  return evaluateHere(*renderer_, scene_, *evaluation, progress);
}

Result<std::string> FrameMaker::drawAll(const Sequence& sequence, const std::string& requestJson, const TakeFrame& take,
                                        ProgressLine& progress) {
  if (const auto* remote = std::get_if<Remote>(&where_)) {
    return sequenceThere(*remote, bundle_, id_, requestJson, take, progress);
  }
  return sequenceHere(*renderer_, scene_, sequence, take, progress);
}

Result<std::string> FrameMaker::drawVideo(const Sequence& sequence, const std::string& requestJson,
                                          const TakeBytes& take, ProgressLine& progress) {
  if (const auto* remote = std::get_if<Remote>(&where_)) {
    return videoThere(*remote, bundle_, id_, requestJson, sequence, take, progress);
  }
  return videoHere(*renderer_, scene_, sequence, take, progress);
}

} // namespace gnomon::cli
