#pragma once

#include <functional>
#include <list>
#include <mutex>
#include <optional>
#include <semaphore>
#include <span>
#include <string>

#include "protocol/evaluation/evaluation.h"
#include "protocol/report/frame_report.h"
#include "server/frames/render_queue.h"
#include "server/scenes/scene_cache.h"
#include "server/system/byte_budget.h"

namespace gnomon {

/// What all evaluations share. Outlives them.
struct EvaluationContext {
  RenderQueue& queue;
  ByteBudget& frameMemory;
  std::chrono::milliseconds timeout{600'000}; ///< from the handler's start to the report
  std::counting_semaphore<> running{1};       ///< how many more may run at once
};

inline constexpr int kEvaluationRetrySeconds = 10; ///< Retry-After where the server is busy with evaluations

/// What an evaluation takes in memory: the largest frame of its variants, one reference, and the visibility of every
/// light. `sceneLights`: how many lights the scene has, for a spec without its own.
std::size_t evaluationBytes(const Evaluation& evaluation, std::size_t sceneLights);

/// One evaluation in progress. It counts as running, and keeps its memory, as long as it exists.
class EvaluationRun {
 public:
  /// A problem of code busy where enough evaluations run already, or other frames use the memory.
  static Result<std::shared_ptr<EvaluationRun>> start(EvaluationContext& context, LoadedScene scene,
                                                      Evaluation evaluation, Clock::time_point deadline);
  ~EvaluationRun();
  EvaluationRun(const EvaluationRun&) = delete;
  EvaluationRun& operator=(const EvaluationRun&) = delete;

  /// Measures. Every frame is a job of its own in the render queue, so that other clients' frames are drawn in between.
  /// `gone` is called often, by any thread; true ends the run.
  Result<EvaluationReport> report(const std::function<bool()>& gone, const EvaluationListener& listener = {});

 private:
  EvaluationRun(EvaluationContext& context, LoadedScene scene, Evaluation evaluation, Clock::time_point deadline);
  Result<Frame> draw(const FrameSpec& spec, const std::function<bool()>& gone);
  Result<double> shimmer(const FrameSpec& spec, std::span<const Camera> path, const std::function<bool()>& gone);

  /// Asks the queue until it has room, the deadline has passed or the client is gone.
  template <class T, class Ask>
  Result<T> askPatiently(const Ask& ask, const std::function<bool()>& gone);

  EvaluationContext& context_;
  LoadedScene scene_;
  Evaluation evaluation_;
  Clock::time_point deadline_;
  ByteLease memory_;
};

/// Settings chosen for earlier frames with a target; the least recently used are dropped first. Any thread.
class QualityChoices {
 public:
  std::optional<QualityReport> find(const std::string& key);
  void keep(const std::string& key, const QualityReport& report);

 private:
  struct Entry {
    std::string key;
    QualityReport report;
  };

  std::mutex mutex_;
  std::list<Entry> entries_; ///< most recently used first
};

/// The settings that meet the target of `spec`: those of an earlier frame of this scene and class of views, or else
/// found by drawing and measuring many frames. Problems as an evaluation gives, with places in `spec`. `gone`: see
/// EvaluationRun::report.
Result<QualityReport> settleQuality(EvaluationContext& context, QualityChoices& choices, const LoadedScene& scene,
                                    const FrameSpec& spec, const std::function<bool()>& gone);

} // namespace gnomon
