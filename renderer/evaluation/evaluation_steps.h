#pragma once

#include <utility>

#include "renderer/evaluation/evaluate.h"

namespace gnomon {

/// Counts an evaluation's steps, tells its listener, and remembers when that asked to stop.
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

} // namespace gnomon
