#include "server/evaluations/evaluation_run.h"

#include <thread>

#include "server/frames/frame_cost.h"

namespace gnomon {
namespace {

Problem busyProblem(const char* detail, std::string limit) {
  return {ProblemCode::busy, "", detail, std::move(limit), ""};
}

} // namespace

EvaluationRun::EvaluationRun(Services& services, LoadedScene scene, Evaluation evaluation, Clock::time_point deadline)
    : services_(services),
      scene_(std::move(scene)),
      evaluation_(std::move(evaluation)),
      deadline_(deadline),
      memory_(services.frameBytes) {}

EvaluationRun::~EvaluationRun() {
  services_.evaluations.release();
}

Result<std::shared_ptr<EvaluationRun>> EvaluationRun::start(Services& services, LoadedScene scene,
                                                            Evaluation evaluation, Clock::time_point deadline) {
  const std::size_t bytes = evaluationBytes(evaluation, scene.summary.lights.size());
  if (bytes > services.frameMemoryBytes) {
    return Problem{ProblemCode::tooLarge, "/spec/width", "The pictures of this evaluation are too large.",
                   std::to_string(services.frameMemoryBytes) + " bytes", std::to_string(bytes) + " bytes"};
  }
  if (!services.evaluations.try_acquire()) {
    return busyProblem("As many evaluations run as may run at once.", "");
  }
  std::shared_ptr<EvaluationRun> run(
      new EvaluationRun(services, std::move(scene), std::move(evaluation), deadline)); // gives the place back
  if (!run->memory_.grow(bytes)) {
    return busyProblem("Frames that are under way fill the memory set aside for them.", "");
  }
  return run;
}

Result<EvaluationReport> EvaluationRun::report(const std::function<bool()>& gone, const EvaluationListener& listener) {
  EvaluationListener watched = listener;
  watched.step = [&](const EvaluationStep& step) {
    return Clock::now() < deadline_ && !gone() && (!listener.step || listener.step(step));
  };
  const EvaluationTools tools{
      [&](const FrameSpec& spec) { return draw(spec, gone); },
      [&](const FrameSpec& spec, std::span<const Camera> path, const Progress&) { return shimmer(spec, path, gone); }};
  auto report = evaluate(scene_.scene, evaluation_, services_.queue.info(), tools, watched);
  if (!report && Clock::now() >= deadline_) {
    const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(services_.evaluationTimeout).count();
    return Problem{ProblemCode::deadlineExceeded, "", "The evaluation took longer than it may.",
                   std::to_string(seconds) + " seconds", ""};
  }
  return report;
}

template <class T, class Ask>
Result<T> EvaluationRun::askPatiently(const Ask& ask, const std::function<bool()>& gone) {
  constexpr std::chrono::milliseconds kNextTry{50};
  while (true) {
    auto answer = ask();
    if (auto* value = std::get_if<T>(&answer)) {
      return std::move(*value);
    }
    if (auto* problems = std::get_if<Problems>(&answer)) {
      return std::move(*problems);
    }
    if (gone() || Clock::now() >= deadline_) {
      return busyProblem("The render queue is full.", std::to_string(std::get<QueueFull>(answer).limit) + " frames");
    }
    std::this_thread::sleep_for(kNextTry); // others fill the queue for the moment
  }
}

Result<Frame> EvaluationRun::draw(const FrameSpec& spec, const std::function<bool()>& gone) {
  auto drawn = askPatiently<QueuedFrame>(
      [&] {
        return services_.queue.render({scene_.scene, spec, deadline_, gone, TileUse::drawnAnew});
      },
      gone);
  if (!drawn) {
    return std::move(drawn).problems();
  }
  return std::move(drawn->frame);
}

Result<double> EvaluationRun::shimmer(const FrameSpec& spec, std::span<const Camera> path,
                                      const std::function<bool()>& gone) {
  const std::vector<Camera> cameras(path.begin(), path.end());
  return askPatiently<double>(
      [&] {
        return services_.queue.shimmer({scene_.scene, spec, cameras, deadline_, gone});
      },
      gone);
}

} // namespace gnomon
