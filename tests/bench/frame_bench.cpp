// A whole warm request (JSON in, PNG bytes out) and its stages, as ratios to the depth-only floor measured in the same
// run: floor and frame take turns, so that noise meets both alike.
#include <algorithm>
#include <benchmark/benchmark.h>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>
#include <string_view>

#include "protocol/base/elapsed.h"
#include "protocol/json/json_codec.h"
#include "renderer/render.h"
#include "tests/bench/depth_floor.h"
#include "tests/bench/tools.h"
#include "tests/support/png_of.h"

namespace gnomon::bench {
namespace {

using Clock = std::chrono::steady_clock;

struct Size {
  int width, height;
};

std::string specJson(const Size& size, int samples, const std::string& filter) {
  return Json{{"width", size.width},
              {"height", size.height},
              {"camera", {{"node", "camera"}}},
              {"lights", {{{"type", "directional"}, {"sun", {{"azimuthDegrees", 150}, {"elevationDegrees", 35}}}}}},
              {"antialiasing", samples > 1 ? "msaa4x" : "none"},
              {"shadow", {{"technique", "shadowMap"}, {"cascadeCount", 4}, {"filter", Json::parse(filter)}}},
              {"output", {{"format", "png"}, {"pngCompression", 1}}}}
      .dump();
}

struct Row {
  std::string name;
  std::vector<std::pair<std::string, double>> ratios;
};

std::vector<Row>& rows() {
  static std::vector<Row> all;
  return all;
}

/// Bytes of shadow atlases that the renderer keeps: none, so that each request casts its shadows, or the default.
std::size_t tileCacheBytes = 0;

/// OpenGL, which the floor is drawn by.
Renderer& renderer() {
  static Renderer made = *Renderer::create({.backend = {.device = DeviceChoice::gl}, .tileCacheBytes = tileCacheBytes});
  return made;
}

const ScenePtr& city() {
  static const ScenePtr scene = *loadScene({testing::readFile(GNOMON_TEST_SCENES "/city.glb"), {}});
  return scene;
}

/// Stage times of one request, milliseconds, in order; "whole" is measured from outside.
std::vector<StageTime> request(const std::string& json) {
  const auto begin = Clock::now();
  const auto spec = decodeFrameSpec(json);
  Frame frame = *renderer().render(city(), *spec);
  const auto encodeBegin = Clock::now();
  benchmark::DoNotOptimize(testing::pngOf(frame));
  std::vector<StageTime> stages = std::move(frame.report.stages);
  stages.push_back({"encode", millisecondsSince(encodeBegin)});
  stages.push_back({"whole", millisecondsSince(begin)});
  return stages;
}

void wholeRequest(benchmark::State& state, const std::string& name, Size size, int samples, const std::string& filter) {
  const std::string json = specJson(size, samples, filter);
  request(json);
  DepthFloor floor(*city(), *decodeFrameSpec(json), samples);
  floor.draw();
  std::map<std::string, std::vector<double>> times;
  std::vector<std::string> order;
  for (auto _ : state) {
    times["floor"].push_back(floor.draw());
    const std::vector<StageTime> stages = request(json);
    order.clear();
    for (const StageTime& stage : stages) {
      times[stage.stage].push_back(stage.milliseconds);
      order.push_back(stage.stage);
    }
    state.SetIterationTime(stages.back().milliseconds / 1000);
  }
  const double floorMs = median(times["floor"]);
  Row row{name, {{"floor ms", floorMs}}};
  for (const std::string& stage : order) {
    const double ratio = median(times[stage]) / floorMs;
    state.counters[stage + "/floor"] = ratio;
    row.ratios.emplace_back(stage, ratio);
  }
  state.counters["floorTriangles"] = static_cast<double>(floor.triangles());
  // The library runs a case again with more iterations until it is long enough: the last run counts.
  std::erase_if(rows(), [&](const Row& earlier) { return earlier.name == name; });
  rows().push_back(std::move(row));
}

void printTable() {
  if (rows().empty()) return;
  std::printf("\nRatios to the depth-only floor, medians. Renderer: %s\n\n| request |",
              renderer().info().renderer.c_str());
  for (const auto& [stage, value] : rows().front().ratios) std::printf(" %s |", stage.c_str());
  std::printf("\n|---|");
  for (std::size_t i = 0; i < rows().front().ratios.size(); ++i) std::printf("---|");
  for (const Row& row : rows()) {
    std::printf("\n| %s |", row.name.c_str());
    for (const auto& [stage, value] : row.ratios) std::printf(" %.2f |", value);
  }
  std::printf("\n");
}

} // namespace
} // namespace gnomon::bench

int main(int argc, char** argv) {
  using namespace gnomon::bench;
  const std::string pcf5 = R"({"type":"pcf","size":5})";
  for (const Size size : {Size{640, 360}, Size{1280, 720}, Size{1920, 1080}}) {
    for (const int samples : {1, 4}) {
      const std::string name =
          std::to_string(size.width) + "x" + std::to_string(size.height) + (samples > 1 ? " msaa4x" : "");
      benchmark::RegisterBenchmark(name.c_str(), wholeRequest, name, size, samples, pcf5)
          ->UseManualTime()
          ->Unit(benchmark::kMillisecond)
          ->MinTime(4);
    }
  }
  if (argc > 1 && std::string_view(argv[1]) == "--keep-tiles") {
    tileCacheBytes = gnomon::RendererOptions{}.tileCacheBytes;
    std::rotate(argv + 1, argv + 2, argv + argc);
    --argc;
  }
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  printTable();
  return 0;
}
