#include "server/handlers/job_runners.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "protocol/json/json_codec.h"
#include "server/handlers/sequence_frames.h"
#include "server/system/log.h"

namespace gnomon {
namespace {

constexpr std::chrono::milliseconds kShortest{100}; ///< pause where the queue can't be reached
constexpr std::chrono::milliseconds kLongest{5'000};

/// Whether the frame may be drawn another time.
bool passes(const Problem& problem) {
  return problem.code == ProblemCode::unavailable || problem.code == ProblemCode::busy ||
         problem.code == ProblemCode::deadlineExceeded;
}

/// SHA-256 of all that the pictures depend on.
std::string contentKey(const FrameTurn& turn, const Sequence& sequence, const RendererInfo& renderer) {
  Sha256 hash;
  for (const std::string& part : {turn.scene, renderer.fingerprint}) hash.add(part + "\n");
  hash.add(jsonText(toJson(frameSpec(sequence, turn.index, turn.before))));
  return hash.hex();
}

} // namespace

Result<std::shared_ptr<const Sequence>> JobSequences::of(const std::string& job) {
  {
    const std::lock_guard lock(mutex_);
    if (const Entry* const known = entries_.find(job, &Entry::job)) return known->sequence;
  }
  const auto request = jobs_.request(job);
  if (!request) return request.problems();
  auto read = *request ? decodeSequence(**request) : Result<Sequence>(Problem{});
  if (!read) return std::shared_ptr<const Sequence>();
  auto sequence = std::make_shared<const Sequence>(*std::move(read));
  const std::lock_guard lock(mutex_);
  entries_.add({job, sequence});
  entries_.keepNewest(kMost);
  return sequence;
}

HeldFrames::HeldFrames(JobQueue& jobs, std::chrono::milliseconds lease)
    : jobs_(jobs), pause_(lease / 4), thread_([this] { renew(); }) {}

HeldFrames::~HeldFrames() {
  stop_.raise();
  thread_.join();
}

void HeldFrames::renew() {
  while (!stop_.waitFor(pause_)) {
    std::list<std::shared_ptr<Held::Entry>> held;
    {
      const std::lock_guard lock(mutex_);
      held = held_;
    }
    for (const auto& entry : held) {
      try {
        const auto renewal = jobs_.renew(entry->turn);
        if (renewal) entry->isWanted = *renewal; // else the queue is away, and what is drawn is kept once it is back
      } catch (const std::exception& error) {    // out of memory: the next time comes soon
        logEvent("jobs", error.what());
      }
    }
  }
}

HeldFrames::Held::Held(HeldFrames& frames, const FrameTurn& turn)
    : frames_(frames), entry_(std::make_shared<Entry>(turn)) {
  const std::lock_guard lock(frames_.mutex_);
  frames_.held_.push_back(entry_);
}

HeldFrames::Held::~Held() {
  const std::lock_guard lock(frames_.mutex_);
  frames_.held_.remove(entry_);
}

JobRunners::JobRunners(Services& services, std::size_t threads)
    : services_(services), sequences_(services.jobs), held_(services.jobs, services.jobLimits.lease) {
  for (std::size_t i = 0; i < threads; ++i) threads_.emplace_back([this] { takeFrames(); });
}

JobRunners::~JobRunners() {
  stop_.raise();
  for (std::thread& thread : threads_) thread.join();
}

void JobRunners::takeFrames() {
  constexpr std::chrono::milliseconds kPatience{500};
  auto pauseAfter = kShortest;
  while (!stopping()) {
    try {
      const auto turn = services_.jobs.take(kPatience);
      if (!turn) {
        say(turn.problems());
        stop_.waitFor(pauseAfter);
        pauseAfter = std::min(pauseAfter * 2, kLongest);
        continue;
      }
      pauseAfter = kShortest;
      queueIsThere();
      if (*turn) draw(**turn);
    } catch (const std::exception& error) {
      logEvent("jobs", error.what()); // out of memory: the frame is given to others once this one is not renewed
      stop_.waitFor(kLongest);
    }
  }
}

/// Each attempt of each thread has the same to say while the queue is away.
void JobRunners::say(const Problems& problems) {
  const std::lock_guard lock(saying_);
  if (said_ == problems.front().detail) return;
  said_ = problems.front().detail;
  logEvent("jobs", said_);
}

void JobRunners::queueIsThere() {
  const std::lock_guard lock(saying_);
  if (said_.empty()) return;
  said_.clear();
  logEvent("jobs", "The queue of jobs can be reached again.");
}

void JobRunners::draw(const FrameTurn& turn) {
  const HeldFrames::Held held(held_, turn);
  const auto sequence = sequences_.of(turn.job);
  if (!sequence) return giveBack(turn, false);
  if (*sequence == nullptr) return count(FrameEnd::unwanted);
  if (turn.index < (*sequence)->first || turn.index >= (*sequence)->count) {
    return fail(turn, {{ProblemCode::internal, "", "The job's request has no frame of this index.", "",
                        std::to_string(turn.index)}});
  }
  const auto used = services_.store.use(turn.scene);
  auto bundle = used ? services_.store.bundle(turn.scene) : Result<StoredBundle>(used.problems());
  if (!bundle) {
    const bool isPassing = passes(bundle.problems().front()) && turn.deliveries < services_.jobLimits.deliveries;
    if (isPassing) return giveBack(turn, true);
    return fail(turn, bundle.problems());
  }
  const auto gone = [&] { return !held.isWanted() || stop_.raised(); };
  ByteLease room(services_.replyBytes, {turn.client, turn.job});
  const auto takeRoom = [&](std::size_t bytes) {
    return room.growBy(std::min(bytes, services_.replyBytes.total()), Clock::time_point::max(), gone) || gone();
  };
  Task task;
  task.order.kind = OrderKind::sequenceFrame;
  task.order.scene = turn.scene;
  task.order.isStored = bundle->isStored;
  task.bundle = std::move(bundle->file);
  task.client = turn.client;
  task.lane = Lane::sequence;
  task.deadline = Clock::time_point::max();
  DoneFrame frame = drawSequenceFrame(services_, {.sequence = **sequence,
                                                  .index = turn.index,
                                                  .before = turn.before,
                                                  .counts = services_.store.counts(turn.scene).value_or(SceneCounts()),
                                                  .task = std::move(task),
                                                  .isPatient = true,
                                                  .gone = gone,
                                                  .takeRoom = takeRoom});
  if (!held.isWanted()) return count(FrameEnd::unwanted);
  if (frame.problems.empty()) {
    return keep(turn, {.note = {.contentKey = contentKey(turn, **sequence, services_.workers.info()),
                                .carried = std::move(frame.own),
                                .warnings = std::move(frame.warnings),
                                .stages = std::move(frame.result.outcome.stages),
                                .milliseconds = frame.milliseconds,
                                .pictures = frame.pictures.list()},
                       .pictures = std::move(frame.pictures)});
  }
  if (stopping()) return giveBack(turn, false);
  if (passes(frame.problems.front()) && turn.deliveries < services_.jobLimits.deliveries) return giveBack(turn, true);
  fail(turn, frame.problems);
}

/// What was drawn is not thrown away because the queue can't be reached for a while.
void JobRunners::keep(const FrameTurn& turn, const JobFrame& frame) {
  constexpr std::chrono::minutes kPatience{5}; // others have long taken the frame then
  const auto until = Clock::now() + kPatience;
  for (auto wait = kShortest;; wait = std::min(wait * 2, kLongest)) {
    const auto kept = services_.jobs.finish(turn, frame);
    if (kept) return count(FrameEnd::drawn);
    if (stop_.raised() || Clock::now() >= until) return count(FrameEnd::givenBack);
    say(kept.problems());
    stop_.waitFor(wait);
  }
}

/// Where that can't be stored, the frame is not renewed and goes to others.
void JobRunners::fail(const FrameTurn& turn, const Problems& problems) {
  count(FrameEnd::failed);
  const auto stored = services_.jobs.fail(turn, problems);
  if (!stored) say(stored.problems());
}

/// The same.
void JobRunners::giveBack(const FrameTurn& turn, bool isTried) {
  count(FrameEnd::givenBack);
  const auto stored = services_.jobs.giveBack(turn, isTried);
  if (!stored) say(stored.problems());
  if (!stopping()) stop_.waitFor(kShortest);
}

} // namespace gnomon
