// What shadows cost against what they are asked for, as ratios to the depth-only floor measured in the same run. Writes
// README.md and a plot for each series into a folder.
#include <CLI/CLI.hpp>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <map>
#include <memory>
#include <thread>

#include "protocol/base/elapsed.h"
#include "protocol/json/json_codec.h"
#include "protocol/spec/frame_lights.h"
#include "tests/bench/cost_series.h"
#include "tests/bench/depth_floor.h"
#include "tests/bench/svg_plot.h"
#include "tests/bench/tools.h"

namespace gnomon::bench {
namespace {

/// Medians of one point, milliseconds.
struct Cost {
  double floor = 0;                     ///< the bare depth-only draw of what is in view
  double whole = 0;                     ///< a warm request, from the decoded spec to pixels, not encoded
  std::map<std::string, double> stages; ///< of the report
  std::string problem;                  ///< why there is no figure; empty = measured
};

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
  const auto begin = std::chrono::steady_clock::now();
  const auto frame = renderer.render(point.scene, spec);
  const double whole = millisecondsSince(begin);
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

/// Draws floors and frames in turn, so that noise meets all alike, after a first of each that is not counted. Every
/// frame turns the lights by a little, so that none of its shadows can be one that was kept. One cost for each point.
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

/// What is shown of a frame's stages; the rest of `whole` is the survey, the plan and the read-back.
const std::vector<std::string> kShown = {"shadow", "shade"};

std::string ratio(double milliseconds, const Cost& cost) {
  return rounded(milliseconds / cost.floor, 2);
}

double stageOf(const Cost& cost, const std::string& stage) {
  const auto found = cost.stages.find(stage);
  return found == cost.stages.end() ? 0 : found->second;
}

std::string tableRows(const CostSeries& series, const std::vector<Cost>& costs) {
  std::string out;
  for (std::size_t i = 0; i < costs.size(); ++i) {
    const Cost& cost = costs[i];
    out += "| " + series.name + " | " + series.points[i].label + " | ";
    if (!cost.problem.empty()) {
      out += "| | | " + cost.problem + " |\n";
      continue;
    }
    out += rounded(cost.floor, 1) + " | ";
    for (const std::string& stage : kShown) out += ratio(stageOf(cost, stage), cost) + " | ";
    out += "**" + ratio(cost.whole, cost) + "** |\n";
  }
  return out;
}

Plot plotOf(const CostSeries& series, const std::vector<Cost>& costs) {
  Plot plot{series.title, series.axis, "floors", {}, {}, {}};
  for (const CostPoint& point : series.points) {
    plot.labels.push_back(point.label);
    if (series.numeric) plot.xs.push_back(point.x);
  }
  const auto line = [&](const std::string& name, auto milliseconds) {
    PlotLine made{name, {}};
    for (const Cost& cost : costs) {
      made.values.push_back(cost.problem.empty() ? std::optional(milliseconds(cost) / cost.floor) : std::nullopt);
    }
    plot.lines.push_back(std::move(made));
  };
  line("whole frame", [](const Cost& cost) { return cost.whole; });
  for (const std::string& stage : kShown) line(stage, [&](const Cost& cost) { return stageOf(cost, stage); });
  return plot;
}

std::string headOf(const Renderer& renderer, const nlohmann::json& spec, int rounds) {
  return "# What shadows cost\n\nMade by `bench_costs` on " + renderer.info().renderer + ", " +
         std::to_string(std::thread::hardware_concurrency()) + " cores, " + std::to_string(spec["width"].get<int>()) +
         " x " + std::to_string(spec["height"].get<int>()) + ", antialiasing " +
         spec["antialiasing"].get<std::string>() + ": medians of " + std::to_string(rounds) +
         " frames. The floor, in milliseconds, is a bare depth-only draw of the triangles in view; the other figures "
         "are multiples of it. No shadow is kept from one frame to the next. Each series changes one thing of one "
         "request: the city of 600,000 triangles, one sun, PCF 5 x 5, 4 cascades of 1024 x 1024; the last one takes a "
         "field of bodies instead of the city.\n\n";
}

} // namespace
} // namespace gnomon::bench

int main(int argc, char** argv) {
  using namespace gnomon::bench;
  namespace fs = std::filesystem;
  CLI::App app{"Costs of shadows as ratios to the depth-only floor. Ratios mean something only on a quiet machine."};
  fs::path folder;
  int rounds = 9;
  std::string only;
  nlohmann::json spec = {{"width", 1280}, {"height", 720}, {"antialiasing", "msaa4x"}};
  app.add_option("--output", folder, "Where README.md and the plots go, e.g. tests/bench/results/llvmpipe-2-cores")
      ->required();
  app.add_option("--rounds", rounds, "Frames of each point that count")->check(CLI::Range(1, 1000));
  app.add_option("--series", only, "Only this one: cascades, spots, tiles, filters, triangles");
  app.add_option_function<int>(
      "--width",
      [&](const int& width) {
        spec["width"] = width;
        spec["height"] = width * 9 / 16;
      },
      "Of the picture, 16 to 9; 1280 when absent");
  CLI11_PARSE(app, argc, argv);

  // OpenGL, which the floors are drawn by.
  auto renderer = gnomon::Renderer::create({.backend = {.device = gnomon::DeviceChoice::gl}});
  if (!renderer) {
    std::cerr << renderer.problems().front().detail << '\n';
    return 1;
  }
  fs::create_directories(folder);
  std::string table = "| series | point | floor, ms | shadow | shade | whole |\n|---|---|---|---|---|---|\n";
  std::string plots;
  for (const CostSeries& series : costSeries(spec)) {
    if (!only.empty() && series.name != only) continue;
    std::cerr << series.title << '\n';
    const std::vector<Cost> costs = measure(*renderer, series, rounds);
    std::cerr << tableRows(series, costs);
    table += tableRows(series, costs);
    writeText(folder / (series.name + ".svg"), svgOf(plotOf(series, costs)));
    plots += "\n![" + series.title + "](" + series.name + ".svg)\n";
  }
  writeText(folder / "README.md", headOf(*renderer, spec, rounds) + table + plots);
  return 0;
}
