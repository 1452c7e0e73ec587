#pragma once

#include <optional>
#include <vector>

#include "renderer/evaluation/evaluation_steps.h"
#include "renderer/reference/reference.h"
#include "renderer/resolve/resolve_frame.h"

namespace gnomon {

/// A variant that can be drawn.
struct Subject {
  std::size_t index = 0; ///< of the variant
  ResolvedFrame frame;
  std::vector<int> lights; ///< whose shadows are measured: those that cast with a strength above 0
};

/// The variant on its scene; a problem where nothing in it casts a shadow, or where its shadows take too much memory.
Result<Subject> subjectOf(const Scene& scene, const Variant& variant, std::size_t index);

/// Subjects that one reference serves, in order of their first; indices into `subjects`.
std::vector<std::vector<std::size_t>> shareReferences(const std::vector<Subject>& subjects);

/// Traces the truth about subjects of one scene.
class Truth {
 public:
  Truth(std::shared_ptr<const Scene> scene, int samples) : scene_(std::move(scene)) { report_.samples = samples; }

  /// A problem of code `unavailable` where the steps' listener asked to stop.
  Result<Reference> trace(const Subject& subject, EvaluationSteps& steps);

  const ReferenceReport& report() const { return report_; }

 private:
  Result<const TracedScene*> traced(const ResolvedFrame& frame);

  std::shared_ptr<const Scene> scene_;
  std::optional<TracedScene> traced_; ///< the last one
  int tracedIndex_ = 0;               ///< of its glTF scene
  ReferenceReport report_;
};

/// The subject's metrics: a frame drawn for each of its lights, held against the truth.
Result<ErrorMetrics> measureSubject(const Subject& subject, const Reference& truth, const DrawFrame& draw,
                                    EvaluationSteps& steps);

} // namespace gnomon
