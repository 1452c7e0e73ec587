// Speed against error over many scenes: how many receivers each technique and filter misclassifies, against its time as
// a multiple of a hard shadow map's. Writes README.md and a chart into a folder.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <thread>

#include "protocol/evaluation/evaluation.h"
#include "protocol/json/json_codec.h"
#include "protocol/spec/traits.h"
#include "renderer/charts/charts.h"
#include "renderer/evaluation/evaluate.h"
#include "renderer/render.h"
#include "tests/bench/gathered_scenes.h"
#include "tests/bench/tools.h"

namespace gnomon::bench {
namespace {

namespace fs = std::filesystem;

std::string percent(double share) {
  return rounded(100 * share, 4);
}

std::string orDash(const std::optional<double>& value) {
  return value ? rounded(*value, 2) : "-";
}

std::optional<double> medianOf(const std::vector<double>& values) {
  return values.empty() ? std::nullopt : std::optional(median(values));
}

/// What the variants of one evaluation reached over many scenes. The first variant is what times are held against.
class AccuracySums {
 public:
  explicit AccuracySums(const std::vector<Variant>& variants);

  /// Left out where the first variant could not be measured, or no pixel is a receiver.
  void add(const std::string& scene, const std::vector<EvaluationRow>& rows);

  std::size_t scenes() const { return names_.size(); }

  /// One row a variant: the share over all receivers, and as `milliseconds` the median multiple of the first's time.
  EvaluationReport report() const;
  /// The same as Markdown, with displacements; `all` is that report, its Pareto front marked.
  std::string table(const EvaluationReport& all) const;
  /// Of the first variant: each scene's error, and its displacement beside the predicted one.
  std::string sceneTable() const;

 private:
  struct Sum {
    std::string name;
    double receivers = 0;
    double wrong = 0;
    double falseShadow = 0;
    double falseLit = 0;
    double interior = 0;
    double worst = 0; ///< largest share of a scene
    std::vector<double> ratios;
    std::vector<double> displacements;
    std::size_t refused = 0;
  };
  struct First {
    double misclassified = 0;
    std::optional<double> displacement{};
    std::optional<double> predicted{};
    std::optional<double> texels{};
  };

  std::vector<Sum> sums_;
  std::vector<std::string> names_;
  std::vector<First> firsts_;
};

AccuracySums::AccuracySums(const std::vector<Variant>& variants) {
  for (const Variant& variant : variants) {
    Sum sum;
    sum.name = variant.name;
    sums_.push_back(std::move(sum));
  }
}

void AccuracySums::add(const std::string& scene, const std::vector<EvaluationRow>& rows) {
  const EvaluationRow& first = rows.front();
  if (!first.metrics || !first.milliseconds || first.metrics->receivers == 0) return;
  names_.push_back(scene);
  First& kept = firsts_.emplace_back();
  kept.misclassified = first.metrics->misclassified;
  if (first.metrics->edgeDisplacement) kept.displacement = first.metrics->edgeDisplacement->mean;
  if (first.metrics->predicted) kept.predicted = first.metrics->predicted->edgeDisplacement;
  if (first.metrics->predicted) kept.texels = first.metrics->predicted->median;
  for (std::size_t i = 0; i < sums_.size(); ++i) {
    const EvaluationRow& row = rows[i];
    Sum& sum = sums_[i];
    if (!row.metrics || !row.milliseconds) {
      ++sum.refused;
      continue;
    }
    const auto receivers = static_cast<double>(row.metrics->receivers);
    sum.receivers += receivers;
    sum.wrong += receivers * row.metrics->misclassified;
    sum.falseShadow += receivers * row.metrics->falseShadow;
    sum.falseLit += receivers * row.metrics->falseLit;
    sum.interior += receivers * row.metrics->interior;
    sum.worst = std::max(sum.worst, row.metrics->misclassified);
    sum.ratios.push_back(*row.milliseconds / *first.milliseconds);
    if (row.metrics->edgeDisplacement) sum.displacements.push_back(row.metrics->edgeDisplacement->mean);
  }
}

EvaluationReport AccuracySums::report() const {
  EvaluationReport report;
  for (const Sum& sum : sums_) {
    EvaluationRow& row = report.rows.emplace_back();
    row.name = sum.name;
    if (sum.ratios.empty()) continue;
    row.milliseconds = median(sum.ratios);
    row.metrics = ErrorMetrics{};
    row.metrics->receivers = static_cast<std::uint64_t>(sum.receivers);
    row.metrics->misclassified = sum.wrong / sum.receivers;
    row.metrics->falseShadow = sum.falseShadow / sum.receivers;
    row.metrics->falseLit = sum.falseLit / sum.receivers;
    row.metrics->interior = sum.interior / sum.receivers;
  }
  return report;
}

std::string AccuracySums::table(const EvaluationReport& all) const {
  std::string out =
      "| shadows | x hard map | at most x | misclassified % | false shadow % | false lit % | interior % "
      "| worst scene % | edge, px | scenes refused |\n|---|---|---|---|---|---|---|---|---|---|\n";
  for (std::size_t i = 0; i < sums_.size(); ++i) {
    const EvaluationRow& row = all.rows[i];
    if (!row.metrics) continue;
    const char* const mark = row.pareto.value_or(false) ? "**" : "";
    out += "| " + (mark + sums_[i].name) + mark + " | " + rounded(*row.milliseconds, 2) + " | " +
           rounded(std::ranges::max(sums_[i].ratios), 2) + " | " + percent(row.metrics->misclassified) + " | " +
           percent(row.metrics->falseShadow) + " | " + percent(row.metrics->falseLit) + " | " +
           percent(row.metrics->interior) + " | " + percent(sums_[i].worst) + " | " +
           orDash(medianOf(sums_[i].displacements)) + " | " + std::to_string(sums_[i].refused) + " |\n";
  }
  return out;
}

std::string AccuracySums::sceneTable() const {
  std::string out = "| scene | misclassified by " + sums_.front().name +
                    ", % | its edges off, px | predicted, px | texels, px |\n|---|---|---|---|---|\n";
  for (std::size_t i = 0; i < names_.size(); ++i) {
    out += "| " + names_[i] + " | " + percent(firsts_[i].misclassified) + " | " + orDash(firsts_[i].displacement) +
           " | " + orDash(firsts_[i].predicted) + " | " + orDash(firsts_[i].texels) + " |\n";
  }
  return out;
}

/// Filtered before it is read, which costs as much as a dozen other maps.
bool isPrefiltered(const FrameSpec& spec) {
  return traitsOf(spec.shadow.filter.type).moments;
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
      {"width", 640}, {"height", 360}, {"antialiasing", "none"}, {"camera", {{"fit", true}}}, {"lights", {sunLight()}}};
  app.add_option("--output", folder, "Where README.md and the chart go")->required();
  app.add_option("--assets", assets, "Folder of gathered models with a manifest.json");
  app.add_option("--repeats", repeats, "Timed frames of each variant that is not filtered ahead")
      ->check(CLI::Range(1, 100));
  DeviceChoice device = DeviceChoice::auto_;
  addDevice(app, device);
  CLI11_PARSE(app, argc, argv);

  Renderer renderer = rendererOf(device);
  const FrameSpec decoded = *decodeFrameSpec(spec.dump());
  const std::vector<Variant> variants = variantsOf(spec);
  AccuracySums sums(variants);
  for (const NamedScene& scene : gatheredScenes(assets)) {
    const std::vector<EvaluationRow> rows = rowsOf(renderer, scene.scene, decoded, variants, repeats);
    if (rows.empty()) continue;
    sums.add(scene.name, rows);
    std::cerr << scene.name << '\n';
  }
  fs::create_directories(folder);
  EvaluationReport all = sums.report();
  markPareto(all.rows);
  writeText(folder / "speed_against_error.svg",
            evaluationChart(all, {"time, as a multiple of a hard shadow map's", " x"}));
  writeText(folder / "README.md", headOf(renderer.info(), spec, sums) + sums.table(all) +
                                      "\n![speed against error](speed_against_error.svg)\n\n<!-- /readme -->\n\n" +
                                      sums.sceneTable());
  return 0;
}
