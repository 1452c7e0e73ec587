#include "tests/bench/measure.h"

#include <chrono>
#include <memory>

#include "protocol/json/json_codec.h"
#include "protocol/spec/frame_lights.h"
#include "tests/bench/depth_floor.h"
#include "tests/bench/median.h"

namespace gnomon::bench {
namespace {

using Clock = std::chrono::steady_clock;

/// A point while its rounds go on.
struct Running {
  ScenePtr scene;
  FrameSpec spec;
  std::unique_ptr<DepthFloor> floor;
  std::map<std::string, std::vector<double>> times;
  std::string problem;
};

FrameSpec turned(FrameSpec spec, int round) {
  for (Light& light : *spec.lights) {
    if (light.sun) light.sun->azimuthDegrees += 0.01 * round;
    if (light.direction) (*light.direction)[0] += 1e-4 * round;
  }
  return spec;
}

void drawOnce(Renderer& renderer, Running& point, int round) {
  const double floor = point.floor->draw();
  const FrameSpec spec = turned(point.spec, round);
  const auto begin = Clock::now();
  const auto frame = renderer.render(point.scene, spec);
  const double whole = std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
  if (!frame) {
    point.problem = frame.problems().front().detail;
    return;
  }
  if (round == 0) return;
  point.times["floor"].push_back(floor);
  point.times["whole"].push_back(whole);
  for (const StageTime& stage : frame->report.stages) point.times[stage.stage].push_back(stage.milliseconds);
}

Running start(Renderer& renderer, const CostPoint& point) {
  Running running;
  const auto spec = decodeFrameSpec(point.spec.dump());
  if (!spec) {
    running.problem = spec.problems().front().pointer + ": " + spec.problems().front().detail;
    return running;
  }
  running.spec = *spec;
  running.scene = point.scene();
  running.floor = std::make_unique<DepthFloor>(*running.scene, running.spec, samplesOf(running.spec.antialiasing));
  drawOnce(renderer, running, 0);
  return running;
}

Cost costOf(Running& point) {
  Cost cost;
  cost.problem = point.problem;
  if (!cost.problem.empty()) return cost;
  for (auto& [name, values] : point.times) cost.stages[name] = median(values);
  cost.floor = cost.stages.extract("floor").mapped();
  cost.whole = cost.stages.extract("whole").mapped();
  return cost;
}

} // namespace

std::vector<Cost> measure(Renderer& renderer, const CostSeries& series, int rounds) {
  std::vector<Running> points;
  for (const CostPoint& point : series.points) points.push_back(start(renderer, point));
  for (int round = 1; round <= rounds; ++round) {
    for (Running& point : points) {
      if (point.problem.empty()) drawOnce(renderer, point, round);
    }
  }
  std::vector<Cost> costs;
  for (Running& point : points) costs.push_back(costOf(point));
  return costs;
}

} // namespace gnomon::bench
