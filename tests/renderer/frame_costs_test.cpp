// What frames take on this machine, told from requests like those that it has drawn.
#include <chrono>

#include "protocol/base/elapsed.h"
#include "protocol/cost/cost_model.h"
#include "protocol/cost/frame_cost.h"
#include "protocol/json/json_codec.h"
#include "renderer/render.h"
#include "tests/support/files.h"

namespace gnomon {
namespace {

FrameSpec specOf(const Json& json) {
  const auto spec = decodeFrameSpec(json.dump());
  EXPECT_TRUE(spec) << spec.problems()[0].pointer << ' ' << spec.problems()[0].detail;
  return spec ? *spec : FrameSpec{};
}

double millisecondsOf(const FrameReport& report) {
  double sum = 0;
  for (const StageTime& stage : report.stages) sum += stage.milliseconds;
  return sum;
}

/// A frame that draws all of its tiles, and its picture.
FrameReport reportOf(Renderer& renderer, const ScenePtr& scene, const FrameSpec& spec) {
  auto frame = renderer.render(scene, spec, TileUse::drawnAnew);
  EXPECT_TRUE(frame) << frame.problems()[0].pointer << ' ' << frame.problems()[0].detail;
  if (!frame) return {};
  const auto start = std::chrono::steady_clock::now();
  EXPECT_TRUE(encodePictures(*frame, frame->images.size()));
  frame->report.stages.push_back({"encode", millisecondsSince(start)});
  return frame->report;
}

/// The fastest of some frames of each: the machine may be busy with something else.
std::vector<FrameReport> reportsOf(Renderer& renderer, const ScenePtr& scene, const std::vector<FrameSpec>& specs) {
  constexpr int kRounds = 6;
  std::vector<FrameReport> fastest(specs.size());
  for (int round = 0; round < kRounds; ++round) {
    for (std::size_t i = 0; i < specs.size(); ++i) {
      FrameReport report = reportOf(renderer, scene, specs[i]);
      const bool better = round == 0 || millisecondsOf(report) < millisecondsOf(fastest[i]);
      if (better) fastest[i] = std::move(report);
    }
  }
  return fastest;
}

TEST(FrameCosts, ThreeFramesTellWhatThreeOthersTake) {
  const auto scene = loadScene({testing::readFile(GNOMON_DEMO_SCENE), {}});
  ASSERT_TRUE(scene);
  const SceneCounts counts = sceneCounts(summaryOf(**scene));
  auto renderer = Renderer::create({.backend = {.device = DeviceChoice::cpu}});
  ASSERT_TRUE(renderer);
  const Json sun = {{"sun", {{"elevationDegrees", 35}}}, {"angularDiameterDegrees", 0.53}};
  const std::vector<FrameSpec> specs{
      specOf({{"width", 640}, {"height", 360}}),
      specOf({{"lights", {sun}}, {"shadow", {{"technique", "rayTraced"}, {"raySamples", 16}}}}),
      specOf({{"width", 1920}, {"height", 1080}, {"shadow", {{"size", "XLarge"}}}}),
      specOf({{"lights", {sun}}, {"shadow", {{"cascadeCount", 2}, {"filter", {{"type", "pcf"}, {"size", 7}}}}}}),
      specOf({{"width", 1600}, {"height", 900}, {"antialiasing", "none"}, {"lights", {sun}}}),
      specOf({{"width", 960},
              {"height", 540},
              {"lights", {sun}},
              {"shadow", {{"technique", "rayTraced"}, {"raySamples", 64}}}})};
  constexpr std::size_t kTaught = 3;
  const std::vector<FrameReport> reports = reportsOf(*renderer, *scene, specs);
  CostModel model;
  for (std::size_t i = 0; i < kTaught; ++i) model.learn(frameCost(specs[i], counts), reports[i]);
  for (std::size_t i = kTaught; i < specs.size(); ++i) {
    const double took = millisecondsOf(reports[i]);
    const double told = model.milliseconds(frameCost(specs[i], counts));
    EXPECT_GT(told, took / 2) << i;
    EXPECT_LT(told, took * 2) << i;
  }
}

} // namespace
} // namespace gnomon
