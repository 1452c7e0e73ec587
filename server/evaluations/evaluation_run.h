#pragma once

#include <span>

#include "protocol/evaluation/evaluation.h"
#include "server/frames/services.h"

namespace gnomon {

/// One evaluation on its way. Whoever holds it holds its place among those that run at once, and its memory.
class EvaluationRun {
 public:
  /// A problem of code busy where enough run already or pictures fill their memory.
  static Result<std::shared_ptr<EvaluationRun>> start(Services& services, LoadedScene scene, Evaluation evaluation,
                                                      Clock::time_point deadline);
  ~EvaluationRun();
  EvaluationRun(const EvaluationRun&) = delete;
  EvaluationRun& operator=(const EvaluationRun&) = delete;

  /// Measures; every frame is a job of its own in the render queue, so that those of others go between. `gone` is asked
  /// often, by any thread.
  Result<EvaluationReport> report(const std::function<bool()>& gone, const EvaluationListener& listener = {});

 private:
  EvaluationRun(Services& services, LoadedScene scene, Evaluation evaluation, Clock::time_point deadline);
  Result<Frame> draw(const FrameSpec& spec, const std::function<bool()>& gone);
  Result<double> shimmer(const FrameSpec& spec, std::span<const Camera> path, const std::function<bool()>& gone);

  /// Asks the queue until it has room, or there is no use in it.
  template <class T, class Ask>
  Result<T> askPatiently(const Ask& ask, const std::function<bool()>& gone);

  Services& services_;
  LoadedScene scene_;
  Evaluation evaluation_;
  Clock::time_point deadline_;
  ByteLease memory_;
};

} // namespace gnomon
