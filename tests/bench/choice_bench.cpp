// What shadow maps and rays cost over many scenes and lights, which `technique: auto` has to estimate. Prints CSV.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <ctime>
#include <filesystem>
#include <iostream>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "protocol/json/json_codec.h"
#include "renderer/render.h"
#include "renderer/resolve/plan_input.h"
#include "tests/bench/gathered_scenes.h"
#include "tests/support/files.h"

namespace gnomon::bench {
namespace {

using Json = nlohmann::json;

struct NamedLight {
  const char* name;
  Json light;
};

/// Suns, and lamps above the middle of the scene.
std::vector<NamedLight> lightsOver(const Aabb& bounds) {
  const Json sun = sunLight(), spot = spotOver(bounds);
  Json softSun = sun, ball = spot, point = spot;
  softSun["angularDiameterDegrees"] = 0.53;
  ball["radius"] = 0.02 * glm::length(bounds.max - bounds.min);
  point["type"] = "point";
  point.erase("direction");
  point.erase("outerConeDegrees");
  return {{"sun", sun}, {"soft sun", softSun}, {"spot", spot}, {"soft spot", ball}, {"point", point}};
}

double processorMilliseconds() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) * 1e3 + static_cast<double>(time.tv_nsec) * 1e-6;
}

struct Size {
  int width, height, samples;
};

constexpr Size kSizes[] = {{1280, 720, 4}, {640, 360, 1}};

FrameSpec specOf(const Json& light, const Size& size, const Json& shadow) {
  const Json spec = {
      {"width", size.width},       {"height", size.height}, {"antialiasing", size.samples > 1 ? "msaa4x" : "none"},
      {"camera", {{"fit", true}}}, {"lights", {light}},     {"shadow", shadow}};
  return *decodeFrameSpec(spec.dump());
}

/// Processor milliseconds of a whole frame without a shadow, with a map and with rays, the fastest each; in turn, after
/// a first of each that does not count.
std::array<double, 3> fastest(Renderer& renderer, const ScenePtr& scene, const Json& light, const Size& size,
                              int repeats) {
  const std::array<Json, 3> ways{Json{{"enabled", false}}, Json{{"technique", "shadowMap"}},
                                 Json{{"technique", "rayTraced"}}};
  std::array<double, 3> best;
  best.fill(std::numeric_limits<double>::infinity());
  for (int turn = 0; turn <= repeats; ++turn) {
    for (std::size_t way = 0; way < ways.size(); ++way) {
      const FrameSpec spec = specOf(light, size, ways[way]);
      const double start = processorMilliseconds();
      const auto frame = renderer.render(scene, spec, TileUse::drawnAnew);
      if (frame && turn > 0) best[way] = std::min(best[way], processorMilliseconds() - start);
    }
  }
  return best;
}

} // namespace
} // namespace gnomon::bench

int main(int argc, char** argv) {
  using namespace gnomon;
  using namespace gnomon::bench;
  CLI::App app{"What shadow maps and rays cost over many scenes and lights. Times need a quiet machine."};
  std::vector<std::filesystem::path> folders;
  std::vector<std::string> files, only;
  int repeats = 5;
  DeviceChoice device = DeviceChoice::auto_;
  app.add_option("--folder", folders, "Folder of models with a manifest.json");
  app.add_option("--file", files, "A GLB");
  app.add_option("--light", only, "Only lights of this name");
  app.add_option("--repeats", repeats, "Frames each")->check(CLI::Range(1, 100));
  addDevice(app, device);
  CLI11_PARSE(app, argc, argv);
  Renderer renderer = rendererOf(device);
  std::vector<NamedScene> scenes;
  for (const auto& folder : folders) {
    for (NamedScene& each : gatheredScenes(folder)) scenes.push_back(std::move(each));
  }
  for (const std::string& file : files) {
    if (auto scene = loadScene({testing::readFile(file), {}})) {
      scenes.push_back({std::filesystem::path(file).stem(), std::move(*scene)});
    }
  }
  std::set<std::string> models;
  std::cout << "scene,light,width,height,samples,triangles,holed,off,map,rays\n";
  for (const NamedScene& scene : scenes) {
    const std::string model = modelOf(scene);
    const SceneView& view = scene.scene->scenes[static_cast<std::size_t>(scene.scene->defaultScene)];
    if (!models.insert(model).second || view.bounds.empty()) continue;
    const SceneCounts counts = shadowCounts(*scene.scene, view);
    for (const NamedLight& light : lightsOver(view.bounds)) {
      if (!only.empty() && std::ranges::count(only, light.name) == 0) continue;
      for (const Size& size : kSizes) {
        std::cout << model << ',' << light.name << ',' << size.width << ',' << size.height << ',' << size.samples << ','
                  << counts.triangles << ',' << counts.holed;
        for (const double time : fastest(renderer, scene.scene, light.light, size, repeats)) std::cout << ',' << time;
        std::cout << std::endl;
      }
    }
  }
  return 0;
}
