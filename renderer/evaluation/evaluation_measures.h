#pragma once

#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "renderer/evaluation/evaluate.h"
#include "renderer/frame/environment_cache.h"
#include "renderer/reference/reference.h"
#include "renderer/resolve/resolve_frame.h"

namespace gnomon {

/// Counts an evaluation's steps, calls its listener, and keeps whether that cancelled it.
class EvaluationSteps {
 public:
  EvaluationSteps(EvaluationListener listener, int of) : listener_(std::move(listener)), step_{0, of, 0} {}

  /// Tells that the step of this variant goes on; false = stop.
  bool goOn(std::size_t variant) {
    step_.variant = static_cast<int>(variant);
    stopped_ = stopped_ || (listener_.step && !listener_.step(step_));
    return !stopped_;
  }

  void finish(int count = 1) { step_.done += count; } ///< also of steps that will never be taken
  bool stopped() const { return stopped_; }

  static Problem stopProblem() {
    return {ProblemCode::unavailable, "", "The evaluation was stopped before its end.", "", ""};
  }

 private:
  EvaluationListener listener_;
  EvaluationStep step_;
  bool stopped_ = false;
};

/// Whether a frame's problems end the whole evaluation rather than one variant.
inline bool endsEvaluation(const Problems& problems) {
  const ProblemCode code = problems.front().code;
  return code == ProblemCode::busy || code == ProblemCode::unavailable || code == ProblemCode::deadlineExceeded ||
         code == ProblemCode::internal;
}

/// The lights whose shadows are measured: those that cast with a strength above 0.
std::vector<int> measuredLights(const ResolvedFrame& frame);

/// A variant that can be drawn.
struct Subject {
  std::size_t index = 0; ///< of the variant
  ResolvedFrame frame;
  std::vector<int> lights; ///< measuredLights; kEnvironmentLight alone where debug.light names the environment
};

/// Whether the share of the environment is measured, and no light's shadow.
inline bool measuresEnvironment(const Subject& subject) {
  return subject.lights.front() == kEnvironmentLight;
}

/// The variant on its scene and on the device that draws it; a problem where nothing in it casts a shadow, or where its
/// shadows take too much memory.
Result<Subject> subjectOf(const ScenePtr& scene, const Variant& variant, std::size_t index, const RendererInfo& device);

/// Subjects that one reference serves, in order of their first; indices into `subjects`.
std::vector<std::vector<std::size_t>> shareReferences(const std::vector<Subject>& subjects);

/// Traces the truth about subjects of one scene.
class Truth {
 public:
  /// `environments`: needed where the share of one is asked for.
  Truth(std::shared_ptr<const Scene> scene, int samples, std::shared_ptr<EnvironmentCache> environments)
      : scene_(std::move(scene)), samples_(samples), environments_(std::move(environments)) {
    report_.samples = samples;
  }

  /// A problem of code `unavailable` where the steps' listener asked to stop.
  Result<Reference> trace(const Subject& subject, EvaluationSteps& steps);

  const ReferenceReport& report() const { return report_; }

 private:
  Result<const TracedScene*> traced(const ResolvedFrame& frame);

  /// With the samples a pixel.
  Result<Reference> traced(const Subject& subject, const TraceInput& input, const Progress& progress);

  std::shared_ptr<const Scene> scene_;
  int samples_;
  std::shared_ptr<EnvironmentCache> environments_;
  std::optional<TracedScene> traced_; ///< the last one
  int tracedIndex_ = 0;               ///< of its glTF scene
  ReferenceReport report_;
};

/// The subject's metrics: a frame drawn for each of its lights, held against the truth. Finishes a step a light, also
/// where one of the frames cannot be drawn.
Result<ErrorMetrics> measureSubject(const Subject& subject, const Reference& truth, const DrawFrame& draw,
                                    EvaluationSteps& steps);

/// What a variant's frames took.
struct VariantTimes {
  double milliseconds = 0;       ///< whole frames: the median
  std::vector<StageTime> stages; ///< medians, each by itself
  std::uint64_t memoryBytes = 0; ///< of the last frame
  Problems problems;             ///< not empty = no figures
};

/// Draws one frame of each variant that is not counted, then `repeats` rounds of one frame each. `indices`: of the
/// variants to draw. A problem where the whole evaluation ends.
Result<std::vector<VariantTimes>> timeVariants(const Evaluation& evaluation, std::span<const std::size_t> indices,
                                               const DrawFrame& draw, EvaluationSteps& steps);

/// Of an even number the mean of the middle two; `values` holds at least one.
double median(std::vector<double> values);

} // namespace gnomon
