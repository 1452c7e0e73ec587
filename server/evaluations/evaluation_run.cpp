#include "server/evaluations/evaluation_run.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <thread>

#include "protocol/json/json_codec.h"
#include "protocol/spec/limits.h"
#include "renderer/render.h"
#include "server/frames/frame_reply.h"
#include "server/http/reply.h"

namespace gnomon {

std::size_t evaluationBytes(const Evaluation& evaluation, std::size_t sceneLights) {
  constexpr std::size_t kLight = 13;            ///< what arrives at a pixel and what is shown there
  constexpr std::size_t kShadowPicture = 4 * 4; ///< read back as four floats
  std::size_t most = 0;
  for (const Variant& variant : evaluation.variants) {
    const std::size_t pixels =
        static_cast<std::size_t>(variant.spec.width) * static_cast<std::size_t>(variant.spec.height);
    const std::size_t lights =
        std::max<std::size_t>(variant.spec.lights ? variant.spec.lights->size() : sceneLights, 1);
    const auto visibility = std::min(pixels * lights * kLight, static_cast<std::size_t>(kLimits.maxVisibilityBytes));
    most = std::max(
        most, std::max(frameBytes(variant.spec), pixels * kShadowPicture) + pixels * kReferenceBytes + visibility);
  }
  return most;
}

EvaluationRun::EvaluationRun(EvaluationContext& context, LoadedScene scene, Evaluation evaluation,
                             Clock::time_point deadline)
    : context_(context),
      scene_(std::move(scene)),
      evaluation_(std::move(evaluation)),
      deadline_(deadline),
      memory_(context.frameMemory) {}

EvaluationRun::~EvaluationRun() {
  context_.running.release();
}

Result<std::shared_ptr<EvaluationRun>> EvaluationRun::start(EvaluationContext& context, LoadedScene scene,
                                                            Evaluation evaluation, Clock::time_point deadline) {
  const std::size_t bytes = evaluationBytes(evaluation, scene.summary.lights.size());
  if (bytes > context.frameMemory.total()) {
    return Problem{ProblemCode::tooLarge, "/spec/width", "The pictures of this evaluation are too large.",
                   std::to_string(context.frameMemory.total()) + " bytes", std::to_string(bytes) + " bytes"};
  }
  if (!context.running.try_acquire()) {
    return Problem{ProblemCode::busy, "", "The most evaluations that may run at once are running.", "", ""};
  }
  std::shared_ptr<EvaluationRun> run(
      new EvaluationRun(context, std::move(scene), std::move(evaluation), deadline)); // releases `running` at its end
  if (!run->memory_.grow(bytes)) {
    return Problem{ProblemCode::busy, "", "Other frames in progress use all the memory for frames.", "", ""};
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
  auto report = evaluate(scene_.scene, evaluation_, context_.queue.info(), tools, watched);
  if (!report && Clock::now() >= deadline_) {
    const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(context_.timeout).count();
    return Problem{ProblemCode::deadlineExceeded, "", "The evaluation was not finished before its deadline.",
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
      return std::get<QueueFull>(answer).problem();
    }
    std::this_thread::sleep_for(kNextTry); // other clients fill the queue for the moment
  }
}

Result<Frame> EvaluationRun::draw(const FrameSpec& spec, const std::function<bool()>& gone) {
  auto drawn = askPatiently<QueuedFrame>(
      [&] {
        return context_.queue.render({scene_.scene, spec, deadline_, gone, TileUse::drawnAnew});
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
        return context_.queue.shimmer({scene_.scene, spec, cameras, deadline_, gone});
      },
      gone);
}

namespace {

constexpr std::size_t kMostChoices = 1024; ///< a few kilobytes each

/// Equal for frames that one choice serves.
std::string keyOf(const std::string& sceneId, const std::string& viewClass, FrameSpec spec) {
  spec.camera = Camera{};
  return sceneId + "\n" + viewClass + "\n" + jsonText(toJson(spec));
}

} // namespace

std::optional<QualityReport> QualityChoices::find(const std::string& key) {
  const std::lock_guard lock(mutex_);
  const auto found =
      std::find_if(entries_.begin(), entries_.end(), [&](const Entry& entry) { return entry.key == key; });
  if (found == entries_.end()) {
    return std::nullopt;
  }
  entries_.splice(entries_.begin(), entries_, found);
  return found->report;
}

void QualityChoices::keep(const std::string& key, const QualityReport& report) {
  const std::lock_guard lock(mutex_);
  entries_.remove_if([&](const Entry& entry) { return entry.key == key; });
  entries_.push_front({key, report});
  if (entries_.size() > kMostChoices) {
    entries_.pop_back();
  }
}

Result<QualityReport> settleQuality(EvaluationContext& context, QualityChoices& choices, const LoadedScene& scene,
                                    const FrameSpec& spec, const std::function<bool()>& gone) {
  const auto deadline = Clock::now() + context.timeout;
  const auto views = viewClass(*scene.scene, spec);
  if (!views) {
    return views.problems();
  }
  const std::string key = keyOf(scene.summary.id, *views, spec);
  if (auto known = choices.find(key)) {
    known->cached = true;
    return *std::move(known);
  }
  auto report = chooseQuality(spec, [&](const Evaluation& evaluation) -> Result<EvaluationReport> {
    const auto run = EvaluationRun::start(context, scene, evaluation, deadline);
    if (!run) {
      return run.problems();
    }
    return (*run)->report(gone);
  });
  if (report) {
    choices.keep(key, *report);
  }
  return report;
}

} // namespace gnomon
