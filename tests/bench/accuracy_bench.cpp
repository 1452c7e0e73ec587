// Speed against error over many scenes: how many receivers each technique and filter misclassifies, against its time as
// a multiple of a hard shadow map's. Writes README.md and a chart into a folder.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <thread>

#include "protocol/evaluation/sweeps.h"
#include "protocol/json/json_codec.h"
#include "renderer/charts/evaluation_chart.h"
#include "renderer/evaluation/evaluate.h"
#include "renderer/render.h"
#include "tests/bench/accuracy_sum.h"
#include "tests/bench/gathered_scenes.h"
#include "tests/support/files.h"

namespace gnomon::bench {
namespace {

namespace fs = std::filesystem;

/// Filtered before it is read, which costs as much as a dozen other maps.
bool isPrefiltered(const FrameSpec& spec) {
  const FilterType type = spec.shadow.filter.type;
  return type != FilterType::hard && type != FilterType::pcf && type != FilterType::pcss;
}

/// Hard maps first: all others are held against them. Prefiltered ones last, and of them the middle size alone.
std::vector<Variant> variantsOf(const nlohmann::json& spec) {
  std::vector<Variant> variants;
  for (const Sweep sweep : {Sweep::techniques, Sweep::filters}) {
    for (const SweepVariant& variant : sweepVariants(sweep, spec)) {
      const auto same = [&](const Variant& other) { return other.name == variant.name; };
      if (std::any_of(variants.begin(), variants.end(), same)) continue;
      nlohmann::json patched = spec;
      patched.merge_patch(variant.patch);
      FrameSpec decoded = *decodeFrameSpec(patched.dump());
      if (isPrefiltered(decoded) && decoded.shadow.filter.size != 5) continue;
      variants.push_back({{variant.patch.dump()}, variant.name, std::move(decoded)});
    }
  }
  return variants;
}

/// One row a variant; none where the scene can't be evaluated. Prefiltered ones are timed once, the others `repeats`
/// times.
std::vector<EvaluationRow> rowsOf(Renderer& renderer, const ScenePtr& scene, const FrameSpec& spec,
                                  const std::vector<Variant>& variants, int repeats) {
  const EvaluationTools tools = evaluationTools(renderer, scene);
  const auto middle = std::find_if(variants.begin(), variants.end(),
                                   [](const Variant& variant) { return isPrefiltered(variant.spec); });
  Evaluation quick;
  quick.spec = spec;
  quick.variants = {variants.begin(), middle};
  quick.repeats = repeats;
  Evaluation slow;
  slow.spec = spec;
  slow.variants = {middle, variants.end()};
  slow.repeats = 1;
  std::vector<EvaluationRow> rows;
  for (const Evaluation& part : {quick, slow}) {
    auto report = evaluate(scene, part, renderer.info(), tools);
    if (!report) return {};
    std::move(report->rows.begin(), report->rows.end(), std::back_inserter(rows));
  }
  return rows;
}

std::string headOf(const RendererInfo& info, const nlohmann::json& spec, const AccuracySums& sums) {
  return "# How right shadows are, and what that costs\n\n<!-- readme -->\n\nMade by `bench_accuracy` on " +
         info.renderer + ", " + std::to_string(std::thread::hardware_concurrency()) + " cores, " +
         std::to_string(spec["width"].get<int>()) + " x " + std::to_string(spec["height"].get<int>()) +
         ", antialiasing none, " + std::to_string(sums.scenes()) +
         " scenes, each as a whole in view under one sun, maps of 4 x 1024. Shares are of all receivers of all scenes "
         "together; times are medians over the scenes of a whole warm frame, tiles drawn anew, as multiples of the "
         "hard map's, and the largest multiple of a scene. Displacements are medians over the scenes.\n\n";
}

} // namespace
} // namespace gnomon::bench

int main(int argc, char** argv) {
  using namespace gnomon;
  using namespace gnomon::bench;
  CLI::App app{"Misclassified receivers against time, over many scenes. Times mean something only on a quiet machine."};
  fs::path folder;
  fs::path assets = GNOMON_TEST_ASSETS;
  int repeats = 3;
  nlohmann::json spec = {
      {"width", 640},
      {"height", 360},
      {"antialiasing", "none"},
      {"camera", {{"fit", true}}},
      {"lights", {{{"type", "directional"}, {"sun", {{"azimuthDegrees", 135}, {"elevationDegrees", 40}}}}}}};
  app.add_option("--output", folder, "Where README.md and the chart go")->required();
  app.add_option("--assets", assets, "Folder of gathered models with a manifest.json");
  app.add_option("--repeats", repeats, "Timed frames of each variant that is not filtered ahead")
      ->check(CLI::Range(1, 100));
  std::string device = "auto";
  app.add_option("--device", device, "What draws: cpu, gl, or auto as gnomon chooses")
      ->check(CLI::IsMember({"auto", "cpu", "gl"}));
  CLI11_PARSE(app, argc, argv);

  auto renderer = Renderer::create({.backend = {.device = device == "cpu"  ? DeviceChoice::cpu
                                                          : device == "gl" ? DeviceChoice::gl
                                                                           : DeviceChoice::auto_}});
  if (!renderer) {
    std::cerr << renderer.problems().front().detail << '\n';
    return 1;
  }
  const FrameSpec decoded = *decodeFrameSpec(spec.dump());
  const std::vector<Variant> variants = variantsOf(spec);
  AccuracySums sums(variants);
  for (const NamedScene& scene : gatheredScenes(assets)) {
    const std::vector<EvaluationRow> rows = rowsOf(*renderer, scene.scene, decoded, variants, repeats);
    if (rows.empty()) continue;
    sums.add(scene.name, rows);
    std::cerr << scene.name << '\n';
  }
  fs::create_directories(folder);
  EvaluationReport all = sums.report();
  markPareto(all.rows);
  const auto write = [&](const char* name, const std::string& text) {
    testing::writeFile(folder / name, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
  };
  write("speed_against_error.svg", evaluationChart(all, {"time, as a multiple of a hard shadow map's", " x"}));
  write("README.md", headOf(renderer->info(), spec, sums) + sums.table(all) +
                         "\n![speed against error](speed_against_error.svg)\n\n<!-- /readme -->\n\n" +
                         sums.sceneTable());
  return 0;
}
