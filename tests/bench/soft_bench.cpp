// How right soft shadows are over many scenes, against rays to all of the light, and what being soft costs each
// technique. Prints Markdown.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>
#include <thread>

#include "protocol/base/elapsed.h"
#include "protocol/json/json_codec.h"
#include "renderer/evaluation/evaluate.h"
#include "renderer/render.h"
#include "tests/bench/gathered_scenes.h"
#include "tests/bench/tools.h"

namespace gnomon::bench {
namespace {

using Json = nlohmann::json;

struct Way {
  const char* name;
  Json shadow;
};

/// All, or those of these names.
std::vector<Way> waysCalled(const std::vector<std::string>& names) {
  std::vector<Way> ways{{"rayTraced", {{"technique", "rayTraced"}}},
                        {"lightMap", {{"technique", "lightMap"}}},
                        {"pcss", {{"filter", {{"type", "pcss"}}}}},
                        {"pcss, size XLarge", {{"filter", {{"type", "pcss"}}}, {"size", "XLarge"}}},
                        {"pcf 5", {{"technique", "shadowMap"}, {"filter", {{"type", "pcf"}, {"size", 5}}}}}};
  std::erase_if(ways, [&](const Way& way) { return !names.empty() && std::ranges::count(names, way.name) == 0; });
  return ways;
}

/// A light as JSON, with its size and without.
struct SizedLight {
  const char* name;
  Json soft, sharp;
};

Json with(Json light, const char* field, double value) {
  light[field] = value;
  return light;
}

/// Two suns, and a lamp above the middle of a scene that is taken for one of 10 m.
std::vector<SizedLight> lightsOver(const Aabb& bounds) {
  const Json sun = sunLight(), spot = spotOver(bounds);
  return {{"sun, 0.53 degrees", with(sun, "angularDiameterDegrees", 0.53), sun},
          {"sun, 5 degrees", with(sun, "angularDiameterDegrees", 5), sun},
          {"lamp, 0.2 m", with(spot, "radius", 0.02 * glm::length(bounds.max - bounds.min)), spot}};
}

struct Found {
  std::vector<double> rms, times; ///< one a scene
  std::string worst;              ///< scene of the largest rms
  double squares = 0;             ///< of what each receiver of all scenes is off by
  double receivers = 0;
};

class SoftBench {
 public:
  SoftBench(Renderer& renderer, const std::vector<Way>& ways, int repeats, int samples)
      : renderer_(renderer), ways_(ways), repeats_(repeats), samples_(samples) {}

  void add(const NamedScene& scene, const SizedLight& light, std::vector<Found>& found) {
    Evaluation evaluation;
    evaluation.repeats = 1;
    evaluation.referenceSamples = samples_;
    evaluation.spec = specOf(light.soft, {});
    for (const Way& way : ways_) evaluation.variants.push_back({{}, way.name, specOf(light.soft, way.shadow)});
    const EvaluationTools tools{[&](const FrameSpec& spec) { return draw(scene, spec); }};
    const auto report = evaluate(scene.scene, evaluation, renderer_.info(), tools);
    if (!report) return;
    for (std::size_t i = 0; i < ways_.size(); ++i) {
      const EvaluationRow& row = report->rows[i];
      if (!row.metrics || row.metrics->receivers == 0) continue;
      const double rms = row.metrics->rms;
      if (found[i].rms.empty() || rms > std::ranges::max(found[i].rms)) found[i].worst = modelOf(scene);
      found[i].rms.push_back(rms);
      found[i].squares += rms * rms * static_cast<double>(row.metrics->receivers);
      found[i].receivers += static_cast<double>(row.metrics->receivers);
      found[i].times.push_back(timeRatio(scene, light, ways_[i].shadow));
      std::cerr << scene.name << ", " << light.name << ", " << ways_[i].name << ": " << rms << ", "
                << found[i].times.back() << " x\n";
    }
  }

 private:
  static FrameSpec specOf(const Json& light, const Json& shadow) {
    Json spec = {{"width", 640},
                 {"height", 360},
                 {"antialiasing", "none"},
                 {"views", {"color"}},
                 {"camera", {{"fit", true}}},
                 {"lights", {light}}};
    if (!shadow.empty()) spec["shadow"] = shadow;
    return *decodeFrameSpec(spec.dump());
  }

  Result<Frame> draw(const NamedScene& scene, const FrameSpec& spec) {
    return renderer_.render(scene.scene, spec, TileUse::drawnAnew);
  }

  /// Of warm frames, soft and sharp ones taking turns.
  double timeRatio(const NamedScene& scene, const SizedLight& light, const Json& shadow) {
    const auto timed = [&](const Json& sized) -> std::function<double(int)> {
      return [this, &scene, spec = specOf(sized, shadow)](int) {
        const auto start = std::chrono::steady_clock::now();
        if (!draw(scene, spec)) throw std::runtime_error(scene.name + " is drawn no more");
        return millisecondsSince(start);
      };
    };
    const std::vector<double> times = mediansInTurns(repeats_, {timed(light.soft), timed(light.sharp)});
    return times[0] / times[1];
  }

  Renderer& renderer_;
  const std::vector<Way>& ways_;
  int repeats_, samples_;
};

std::string tableOf(const std::vector<std::pair<std::string, std::vector<Found>>>& lights,
                    const std::vector<Way>& ways) {
  std::string out =
      "| light | technique | rms, median | rms, all | rms, worst | worst scene | x sharp light, median | at most x |\n"
      "|---|---|---|---|---|---|---|---|\n";
  for (const auto& [light, found] : lights) {
    for (std::size_t i = 0; i < found.size(); ++i) {
      if (found[i].rms.empty()) continue;
      out += "| " + light + " | " + ways[i].name + " | " + rounded(median(found[i].rms), 4) + " | " +
             rounded(std::sqrt(found[i].squares / found[i].receivers), 3) + " | " +
             rounded(std::ranges::max(found[i].rms), 3) + " | " + found[i].worst + " | " +
             rounded(median(found[i].times), 2) + " | " + rounded(std::ranges::max(found[i].times), 2) + " |\n";
    }
  }
  return out;
}

} // namespace
} // namespace gnomon::bench

int main(int argc, char** argv) {
  using namespace gnomon;
  using namespace gnomon::bench;
  CLI::App app{"How right soft shadows are over many scenes, and what they cost. Times need a quiet machine."};
  std::filesystem::path assets = GNOMON_TEST_ASSETS;
  int repeats = 5;
  int samples = 1024;
  std::vector<std::string> chosen, only;
  DeviceChoice device = DeviceChoice::auto_;
  app.add_option("--assets", assets, "Folder of gathered models with a manifest.json");
  app.add_option("--technique", chosen, "One of those of the table; may come several times; all where it does not");
  app.add_option("--model", only, "Only this one; may come several times");
  app.add_option("--repeats", repeats, "Timed pairs of frames")->check(CLI::Range(1, 100));
  app.add_option("--samples", samples, "Rays a pixel of the reference")->check(CLI::Range(1, 1024));
  addDevice(app, device);
  CLI11_PARSE(app, argc, argv);

  Renderer renderer = rendererOf(device);
  const std::vector<Way> ways = waysCalled(chosen);
  SoftBench bench(renderer, ways, repeats, samples);
  std::vector<std::pair<std::string, std::vector<Found>>> lights;
  std::size_t scenes = 0;
  std::set<std::string> models;
  for (const NamedScene& scene : gatheredScenes(assets)) {
    const std::string model = modelOf(scene);
    if (!models.insert(model).second) continue; // another file of the same model
    if (!only.empty() && std::ranges::count(only, model) == 0) continue;
    if (scene.scene->scenes.front().bounds.empty()) continue;
    const std::vector<SizedLight> over = lightsOver(scene.scene->scenes.front().bounds);
    if (lights.empty()) {
      for (const SizedLight& light : over) lights.emplace_back(light.name, std::vector<Found>(ways.size()));
    }
    for (std::size_t i = 0; i < over.size(); ++i) bench.add(scene, over[i], lights[i].second);
    ++scenes;
  }
  std::cout
      << "# Soft shadows against rays\n\n<!-- readme -->\n\nMade by `bench_soft` on " << renderer.info().renderer
      << ", " << std::thread::hardware_concurrency() << " cores, 640 x 360, antialiasing none, " << scenes
      << " scenes, each as a whole in view, against " << samples
      << " rays a pixel. Of an rms there are the median of the scenes, "
         "that of the receivers of all scenes together, and the worst of a scene. The lamp is a spot of 0.2 m over "
         "a scene taken for one of 10 m. Times are of whole warm "
         "frames, tiles drawn anew, as multiples of the same frame's under a light without a size.\n\n"
      << tableOf(lights, ways) << "\n<!-- /readme -->\n";
  return 0;
}
