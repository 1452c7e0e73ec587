#include "renderer/evaluation/quality.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <tuple>

#include "protocol/spec/traits.h"
#include "renderer/resolve/plan_input.h"
#include "renderer/resolve/resolve_frame.h"
#include "renderer/resolve/resolve_ground.h"
#include "renderer/scene/scene.h"

namespace gnomon {
namespace {

constexpr int kRepeats = 3; ///< timed frames of a trial

struct MapSettings {
  int cascades;
  int baseSize; ///< texels
};

/// From coarse to fine.
constexpr MapSettings kMaps[] = {{1, 512}, {1, 1024}, {2, 1024}, {4, 512}, {4, 1024}, {4, 2048}};

void apply(const QualityTrial& trial, Shadow& shadow) {
  shadow.technique = trial.shadow.technique;
  shadow.filter = trial.shadow.filter;
  shadow.cascadeCount = trial.shadow.cascadeCount;
  shadow.size = trial.shadow.size;
  shadow.importance = trial.shadow.importance;
  shadow.bias = trial.shadow.bias;
  // Splits belong to a number of cascades.
  if (shadow.partition.mode == PartitionMode::manual) shadow.partition = Partition{};
}

QualityTrial trialOf(const FrameSpec& spec, ShadowTechnique technique, MapSettings map) {
  QualityTrial trial;
  trial.shadow = spec.shadow;
  trial.shadow.technique = technique;
  trial.shadow.filter = Filter{FilterType::hard};
  trial.shadow.cascadeCount = map.cascades;
  trial.shadow.size.reset();
  trial.shadow.importance = ShadowImportance::high;
  trial.shadow.bias = Bias{};
  if (trial.shadow.partition.mode == PartitionMode::manual) trial.shadow.partition = Partition{};
  trial.atlas = Atlas{std::max(4096, spec.atlas.size), map.baseSize, 1};
  trial.settings = std::string(spell(technique));
  if (!traitsOf(technique).layered)
    trial.settings += " " + std::to_string(map.cascades) + " x " + std::to_string(map.baseSize);
  return trial;
}

/// The same problems with places in the spec instead of the evaluation, where they are under /spec.
Problems placedInSpec(Problems problems) {
  constexpr std::string_view kSpec = "/spec";
  for (Problem& problem : problems) {
    if (problem.pointer.starts_with(kSpec)) problem.pointer.erase(0, kSpec.size());
  }
  return problems;
}

} // namespace

std::vector<QualityTrial> qualityTrials(const FrameSpec& spec) {
  std::vector<QualityTrial> trials;
  for (const MapSettings& map : kMaps) trials.push_back(trialOf(spec, ShadowTechnique::shadowMap, map));
  trials.push_back(trialOf(spec, ShadowTechnique::shadowVolume, {4, 1024}));
  trials.push_back(trialOf(spec, ShadowTechnique::rayTraced, {4, 1024}));
  return trials;
}

FrameSpec withTrial(const FrameSpec& spec, const QualityTrial& trial) {
  FrameSpec chosen = spec;
  chosen.quality.reset();
  chosen.atlas = trial.atlas;
  apply(trial, chosen.shadow);
  if (chosen.lights) {
    for (Light& light : *chosen.lights) {
      if (light.shadow) apply(trial, *light.shadow);
    }
  }
  return chosen;
}

Evaluation qualityEvaluation(const FrameSpec& spec, const std::vector<QualityTrial>& trials) {
  Evaluation evaluation;
  evaluation.spec = spec;
  evaluation.spec.quality.reset();
  evaluation.repeats = kRepeats;
  evaluation.spec.debug.light.reset(); // a target is about the shadows of lights
  for (const QualityTrial& trial : trials) {
    evaluation.variants.push_back({{}, trial.settings, withTrial(evaluation.spec, trial)});
  }
  return evaluation;
}

Result<QualityReport> chooseTrial(const Quality& target, std::vector<QualityTrial> trials,
                                  const EvaluationReport& measured) {
  QualityReport report;
  for (std::size_t i = 0; i < trials.size(); ++i) {
    const EvaluationRow& row = measured.rows[i];
    if (!row.metrics || !row.milliseconds) continue;
    trials[i].milliseconds = *row.milliseconds;
    trials[i].error = row.metrics->misclassified;
    report.tried.push_back(std::move(trials[i]));
  }
  if (report.tried.empty()) {
    const auto& problems = measured.rows.front().problems;
    const std::string why = problems && !problems->empty() ? " The first problem: " + problems->front().detail : "";
    return Problem{ProblemCode::invalidValue, "/quality", "None of the settings that were tried can be drawn." + why,
                   "", ""};
  }
  const auto meets = [&](const QualityTrial& trial) {
    return target.maxError ? trial.error <= *target.maxError : trial.milliseconds <= *target.maxMilliseconds;
  };
  // Of those that meet the target the other side decides; of those that don't, the target's own.
  const auto better = [&](const QualityTrial& a, const QualityTrial& b) {
    if (meets(a) != meets(b)) return meets(a);
    const bool bySpeed = target.maxError.has_value() == meets(a);
    return bySpeed ? std::tie(a.milliseconds, a.error) < std::tie(b.milliseconds, b.error)
                   : std::tie(a.error, a.milliseconds) < std::tie(b.error, b.milliseconds);
  };
  const auto best = std::min_element(report.tried.begin(), report.tried.end(), better);
  report.chosen = static_cast<std::size_t>(best - report.tried.begin());
  report.met = meets(*best);
  return report;
}

Result<QualityReport> chooseQuality(const FrameSpec& spec,
                                    const std::function<Result<EvaluationReport>(const Evaluation&)>& measure) {
  auto trials = qualityTrials(spec);
  const auto measured = measure(qualityEvaluation(spec, trials));
  if (!measured) return placedInSpec(measured.problems());
  return chooseTrial(*spec.quality, std::move(trials), *measured);
}

FrameSpec withChoice(const FrameSpec& spec, const QualityReport& report) {
  return withTrial(spec, report.tried[report.chosen]);
}

Result<std::string> viewClass(const Scene& loaded, const FrameSpec& spec) {
  const auto posed = stagedScene(std::shared_ptr<const Scene>(std::shared_ptr<const Scene>(), &loaded), spec);
  if (!posed) return posed.problems();
  const Scene& scene = **posed;
  FrameSpec settled = spec;
  settled.quality.reset();
  const auto frame = resolveFrame(scene, settled);
  if (!frame) return frame.problems();
  const SceneView& view = scene.scenes[static_cast<std::size_t>(frame->scene)];
  const glm::dvec3 size = view.bounds.empty() ? glm::dvec3(1.0) : view.bounds.max - view.bounds.min;
  const double cell = std::max(glm::length(size) / 16.0, 1e-12);
  const glm::dvec3 place = glm::floor((frame->view.eye - anchorOf(view)) / cell);
  const glm::dvec3 way = glm::round(frame->view.forward * 3.0);
  const glm::dvec2 beside = frame->view.center / frame->view.halfSize;
  std::ostringstream text;
  text << (frame->view.perspective ? "perspective" : "orthographic") << ' ' << place.x << ' ' << place.y << ' '
       << place.z << ' ' << way.x << ' ' << way.y << ' ' << way.z << ' '
       << std::floor(std::log2(frame->view.halfSize.x)) << ' ' << std::floor(std::log2(frame->view.halfSize.y)) << ' '
       << std::round(beside.x) << ' ' << std::round(beside.y);
  return text.str();
}

} // namespace gnomon
