#include "renderer/evaluation/evaluation_measures.h"

#include <algorithm>
#include <chrono>

#include "protocol/base/elapsed.h"
#include "renderer/evaluation/evaluate.h"
#include "renderer/frame/environment_of_frame.h"
#include "renderer/frame/settle_frame.h"
#include "renderer/reference/error_measures.h"
#include "renderer/resolve/check_frame.h"
#include "renderer/resolve/plan_input.h"
#include "renderer/resolve/resolve_ground.h"

namespace gnomon {

namespace {

/// What a reference depends on, the rest left at its defaults: equal ones have equal references.
FrameSpec truthKey(const Subject& subject) {
  const FrameSpec& spec = subject.frame.spec;
  FrameSpec key;
  key.width = spec.width;
  key.height = spec.height;
  key.camera = spec.camera;
  key.nodes = spec.nodes;
  key.scene = spec.scene;
  key.materialVariant = spec.materialVariant;
  key.animation = spec.animation;
  if (measuresEnvironment(subject)) {
    key.environment = spec.environment;
    key.environment.samples = {};
    key.debug.light = kEnvironmentName;
    return key;
  }
  key.lights = spec.lights;
  for (std::size_t i = 0; i < key.lights->size(); ++i) {
    Light& light = (*key.lights)[i];
    Shadow shadow;
    shadow.enabled =
        std::find(subject.lights.begin(), subject.lights.end(), static_cast<int>(i)) != subject.lights.end();
    shadow.blendedCasters = light.shadow->blendedCasters;
    shadow.terminator = light.shadow->terminator;
    light.shadow = shadow;
    light.color.reset();
    light.temperatureKelvin.reset();
    light.intensity = 1;
  }
  return key;
}

/// Shadows alone, as numbers, a sample at each pixel's centre: what S is read from. The antialiasing stays, since what
/// the camera's samples see decides how the frame's maps are planned.
FrameSpec shadowSpec(const Subject& subject, int light) {
  FrameSpec spec = subject.frame.spec;
  spec.views = {View::shadow};
  if (light == kEnvironmentLight) {
    spec.lights->clear();
    spec.volumes.clear(); // which the truth leaves out
    spec.debug = {kEnvironmentName};
  } else {
    for (Light& each : *spec.lights) each.shadow->strength = 1;
    spec.debug = {light, 0, true};
  }
  spec.output.format = ImageFormat::exr;
  return spec;
}

/// V, S, whether it is a receiver and how far its blocker is, of each pixel and light.
std::int64_t measuredBytes(const FrameSpec& spec, std::size_t lights) {
  constexpr std::int64_t kPerPixel = 3 * sizeof(float) + 1;
  return std::int64_t{spec.width} * spec.height * static_cast<std::int64_t>(lights) * kPerPixel;
}

/// The frame's own figures, and over all its lights so far how far edges are expected to be off.
void addPrediction(const FrameReport& report, int light, std::optional<PredictedError>& predicted) {
  if (light == kEnvironmentLight) return;
  const auto& ofLight = report.lights[static_cast<std::size_t>(light)].predictedError;
  const auto sum = predicted;
  predicted = report.predictedError;
  if (!predicted) return;
  if (sum) predicted->edgeDisplacement = sum->edgeDisplacement;
  if (sum) predicted->edgeLength = sum->edgeLength;
  if (!ofLight || !ofLight->edgeLength) return;
  const double before = predicted->edgeLength.value_or(0);
  const double length = before + *ofLight->edgeLength;
  predicted->edgeDisplacement =
      (before * predicted->edgeDisplacement.value_or(0) + *ofLight->edgeLength * *ofLight->edgeDisplacement) / length;
  predicted->edgeLength = length;
}

} // namespace

std::vector<int> measuredLights(const ResolvedFrame& frame) {
  std::vector<int> lights = shadowingLights(frame);
  std::erase_if(lights,
                [&](int light) { return (*frame.spec.lights)[static_cast<std::size_t>(light)].shadow->strength <= 0; });
  return lights;
}

Result<Subject> subjectOf(const ScenePtr& scene, const Variant& variant, std::size_t index,
                          const RendererInfo& device) {
  auto settled = settleFrame(scene, variant.spec, &device);
  if (!settled) return settled.problems();
  Subject subject{index, std::move(settled->frame), {}};
  if (showsEnvironment(variant.spec.debug)) {
    subject.lights = {kEnvironmentLight};
  } else {
    subject.lights = measuredLights(subject.frame);
  }
  if (subject.lights.empty()) {
    return Problem{ProblemCode::invalidValue, "/shadow",
                   "No light casts a shadow here, so there is nothing to measure.", "", ""};
  }
  const std::int64_t bytes = measuredBytes(variant.spec, subject.lights.size());
  const Status fits =
      checkVisibilityBytes(bytes, "/lights", "The shadows of so many lights on so many pixels are too large.");
  if (!fits) return fits.problems();
  return subject;
}

std::vector<std::vector<std::size_t>> shareReferences(const std::vector<Subject>& subjects) {
  std::vector<FrameSpec> keys;
  std::vector<std::vector<std::size_t>> groups;
  for (std::size_t i = 0; i < subjects.size(); ++i) {
    const FrameSpec key = truthKey(subjects[i]);
    const auto found = std::find(keys.begin(), keys.end(), key);
    const auto at = static_cast<std::size_t>(found - keys.begin());
    if (found == keys.end()) {
      keys.push_back(key);
      groups.emplace_back();
    }
    groups[at].push_back(i);
  }
  return groups;
}

Result<const TracedScene*> Truth::traced(const ResolvedFrame& frame) {
  auto posed = stagedScene(scene_, frame.spec);
  if (!posed) return posed.problems();
  if (traced_ && &traced_->scene() == posed->get() && tracedIndex_ == frame.scene) return &*traced_;
  const auto begin = std::chrono::steady_clock::now();
  auto built = TracedScene::build(*posed, frame.scene);
  if (!built) return built.problems();
  report_.buildMilliseconds += millisecondsSince(begin);
  traced_ = std::move(*built);
  tracedIndex_ = frame.scene;
  return &*traced_;
}

Result<Reference> Truth::traced(const Subject& subject, const TraceInput& input, const Progress& progress) {
  if (!measuresEnvironment(subject)) return traceReference(input, subject.lights, samples_, progress);
  const int samples = std::max(samples_, kEnvironmentReferenceSamples);
  report_.samples = std::max(report_.samples, samples);
  const auto environment = environmentOf(*environments_, *scene_, subject.frame.spec.environment);
  if (!environment) return environment.problems();
  return traceReference(input, skyLightOf(&*environment), samples, progress);
}

Result<Reference> Truth::trace(const Subject& subject, EvaluationSteps& steps) {
  if (!steps.goOn(subject.index)) return EvaluationSteps::stopProblem();
  const auto scene = traced(subject.frame);
  if (!scene) return scene.problems();
  const FrameSpec& spec = subject.frame.spec;
  const TraceInput input{**scene, subject.frame.view, spec.width, spec.height, *spec.lights, subject.frame.nodes};
  auto reference = traced(subject, input, [&](double) { return steps.goOn(subject.index); });
  if (!reference) return steps.stopped() ? Result<Reference>(EvaluationSteps::stopProblem()) : reference;
  report_.milliseconds += reference->milliseconds;
  ++report_.frames;
  steps.finish();
  return reference;
}

Result<ErrorMetrics> measureSubject(const Subject& subject, const Reference& truth, const DrawFrame& draw,
                                    EvaluationSteps& steps) {
  std::vector<std::vector<float>> shown;
  std::optional<PredictedError> predicted;
  for (const int light : subject.lights) {
    if (!steps.goOn(subject.index)) return EvaluationSteps::stopProblem();
    auto frame = draw(shadowSpec(subject, light));
    if (!frame) {
      steps.finish(static_cast<int>(subject.lights.size() - shown.size())); // this light's and all later ones'
      return frame.problems();
    }
    addPrediction(frame->report, light, predicted);
    shown.push_back(std::get<std::vector<float>>(std::move(frame->images.front().image.pixels)));
    steps.finish();
  }
  ErrorMetrics metrics = measureErrors(truth, shown);
  metrics.predicted = predicted;
  return metrics;
}

namespace {

/// Every frame's time of one stage.
struct StageSeries {
  std::string stage;
  std::vector<double> milliseconds;
};

/// A variant while its rounds go on.
struct Running {
  std::vector<double> whole;
  std::vector<StageSeries> stages;
  std::uint64_t memoryBytes = 0;
  Problems problems;
};

void add(const FrameReport& report, Running& running) {
  double whole = 0;
  for (const StageTime& stage : report.stages) {
    whole += stage.milliseconds;
    auto series = std::find_if(running.stages.begin(), running.stages.end(),
                               [&](const StageSeries& each) { return each.stage == stage.stage; });
    if (series == running.stages.end()) series = running.stages.insert(series, {stage.stage, {}});
    series->milliseconds.push_back(stage.milliseconds);
  }
  running.whole.push_back(whole);
  running.memoryBytes = report.memory.scene + report.memory.atlas + report.memory.targets;
}

VariantTimes timesOf(Running running) {
  VariantTimes times{0, {}, running.memoryBytes, std::move(running.problems)};
  if (!times.problems.empty()) return times;
  times.milliseconds = median(std::move(running.whole));
  for (StageSeries& series : running.stages) {
    times.stages.push_back({std::move(series.stage), median(std::move(series.milliseconds))});
  }
  return times;
}

} // namespace

Result<std::vector<VariantTimes>> timeVariants(const Evaluation& evaluation, std::span<const std::size_t> indices,
                                               const DrawFrame& draw, EvaluationSteps& steps) {
  std::vector<Running> all(indices.size());
  for (int round = 0; round <= evaluation.repeats; ++round) {
    for (std::size_t i = 0; i < indices.size(); ++i) {
      if (!all[i].problems.empty()) continue;
      if (!steps.goOn(indices[i])) return EvaluationSteps::stopProblem();
      const auto frame = draw(evaluation.variants[indices[i]].spec);
      if (!frame && endsEvaluation(frame.problems())) return frame.problems();
      if (!frame) {
        all[i].problems = frame.problems();
        steps.finish(evaluation.repeats + 1 - round);
        continue;
      }
      if (round > 0) add(frame->report, all[i]);
      steps.finish();
    }
  }
  std::vector<VariantTimes> times;
  for (Running& running : all) times.push_back(timesOf(std::move(running)));
  return times;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return (*middle + *std::max_element(values.begin(), middle)) / 2;
}

} // namespace gnomon
