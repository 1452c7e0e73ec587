#include "clients/cli/render/local_render.h"

#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

#include "protocol/json/json_codec.h"
#include "renderer/render.h"

namespace gnomon::cli {
namespace {

class StopWatch {
 public:
  double milliseconds() const {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

std::vector<std::string> viewNames(const FrameSpec& spec) {
  return toJson(spec).at("views");
}

Result<std::vector<Picture>> encode(const Frame& frame, const FrameSpec& spec) {
  const auto names = viewNames(spec);
  std::vector<Picture> pictures;
  if (spec.output.format == ImageFormat::exr) {
    auto file = encodeExr(frame);
    if (!file) return file.problems();
    pictures.push_back({names.front(), std::move(*file)});
    return pictures;
  }
  for (std::size_t i = 0; i < names.size(); ++i) {
    auto file = encodePng(frame, i);
    if (!file) return file.problems();
    pictures.push_back({names[i], std::move(*file)});
  }
  return pictures;
}

/// A spec without a target, and how its target was met.
struct Settled {
  FrameSpec spec;
  std::optional<QualityReport> quality;
};

Result<Settled> settleTarget(const ScenePtr& scene, const FrameSpec& spec, Renderer& renderer, Progress& progress) {
  if (!spec.quality) return Settled{spec, std::nullopt};
  progress.stage("finding settings");
  auto trials = qualityTrials(spec);
  const auto draw = [&](const FrameSpec& variant) { return renderer.render(scene, variant, TileUse::drawnAnew); };
  const auto measured = evaluate(scene, qualityEvaluation(spec, trials), renderer.info(), {draw, {}});
  if (!measured) return measured.problems();
  auto report = chooseTrial(*spec.quality, std::move(trials), *measured);
  if (!report) return report.problems();
  FrameSpec chosen = withTrial(spec, report->tried[report->chosen]);
  return Settled{std::move(chosen), std::move(*report)};
}

} // namespace

Result<Rendered> renderHere(const SceneBundle& bundle, const FrameSpec& spec, const BackendOptions& backend,
                            Progress& progress) {
  // The encoder's libraries load while the scene and the graphics context do.
  const std::jthread warming(warmEncoders);

  progress.stage("loading the scene");
  const StopWatch load;
  auto scene = loadScene(bundle);
  if (!scene) return scene.problems();
  const double loadMs = load.milliseconds();

  progress.stage("starting the renderer");
  RendererOptions options;
  options.backend = backend;
  auto renderer = Renderer::create(options);
  if (!renderer) return renderer.problems();

  auto settled = settleTarget(*scene, spec, *renderer, progress);
  if (!settled) return settled.problems();
  progress.stage("rendering");
  auto frame = renderer->render(*scene, settled->spec);
  if (!frame) return frame.problems();
  frame->report.quality = std::move(settled->quality);

  progress.stage("encoding");
  const StopWatch encoding;
  auto pictures = encode(*frame, spec);
  if (!pictures) return pictures.problems();
  auto& stages = frame->report.stages;
  stages.insert(stages.begin(), {"load", loadMs});
  stages.push_back({"encode", encoding.milliseconds()});
  return Rendered{std::move(*pictures), toJson(frame->report).dump(2) + "\n"};
}

} // namespace gnomon::cli
