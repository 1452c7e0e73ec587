#include "server/handlers/job_reply.h"

#include <algorithm>
#include <array>
#include <ctime>

#include "protocol/sequence/sequence.h"

namespace gnomon {
namespace {

std::string timeTextOf(std::int64_t milliseconds) {
  const auto seconds = static_cast<std::time_t>(milliseconds / 1000);
  std::tm parts{};
  ::gmtime_r(&seconds, &parts);
  std::array<char, 40> text{};
  const std::size_t length = std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &parts);
  return {text.data(), length};
}

} // namespace

Job jobOf(const JobProgress& progress, std::chrono::seconds age) {
  const std::string address = "/v1/jobs/" + progress.id;
  Job job{.id = progress.id,
          .state = progress.state,
          .scene = progress.scene,
          .first = progress.first,
          .done = progress.done,
          .of = progress.count - progress.first,
          .bytes = progress.bytes,
          .created = timeTextOf(progress.created),
          .expires = timeTextOf(progress.changed + std::chrono::milliseconds(age).count()),
          .problems = progress.problems,
          .address = address,
          .result = address + "/result",
          .frames = address + "/frames/{index}"};
  if (!progress.key.empty()) job.key = progress.key;
  if (progress.started > 0) job.started = timeTextOf(progress.started);
  if (progress.ended > 0) job.ended = timeTextOf(progress.ended);
  return job;
}

Result<JobProgress> jobAt(Services& services, const RouteCall& call) {
  const std::string& id = call.values.at("id");
  auto found = services.jobs.find(id);
  if (!found) return found.problems();
  if (!*found || ((*found)->key != call.request.key && !call.request.isAdmin)) return unknownJob(id);
  return **std::move(found);
}

HttpReply jobProblem(const Problems& problems, const RouteCall& call) {
  constexpr int kRetrySeconds = 5;
  const bool isBusy = atLeastOne(problems).front().code == ProblemCode::busy;
  return problemReply(
      problems, call.request.id,
      {.retryAfterSeconds = kRetrySeconds, .refusal = isBusy ? RefusalReason::permits : RefusalReason::none});
}

JobFrames::JobFrames(Services& services, JobWaiting waiting, Holder holder, std::function<bool()> clientGone)
    : services_(services),
      waiting_(std::move(waiting)),
      holder_(std::move(holder)),
      clientGone_(std::move(clientGone)),
      next_(waiting_.seen.first),
      carried_(waiting_.seen.carried) {}

/// Why there will be no next frame, unless it is there.
Problems JobFrames::whyNone() const {
  const JobProgress& job = waiting_.seen;
  if (!lost_.empty()) return lost_;
  if (job.state == JobState::failed) return atLeastOne(job.problems);
  if (isOver(job)) return {unknownJob(job.id)};
  if (services_.draining) return {{ProblemCode::unavailable, "", "The server is shutting down.", "", ""}};
  if (clientGone_()) return {{ProblemCode::unavailable, "", "The client left.", "", ""}};
  if (Clock::now() < waiting_.until) return {};
  return {{ProblemCode::deadlineExceeded, "",
           "The job was not done in the time of a sequence (--sequence-timeout); it goes on, and may be asked for "
           "again.",
           "", ""}};
}

std::shared_ptr<ReplyWait> JobFrames::wait(std::string_view heartbeat) {
  const auto latest = waiting_.job->latest();
  if (*latest) {
    waiting_.seen = **latest;
  } else {
    lost_ = latest->problems();
  }
  const auto note = services_.jobs.note(waiting_.seen.id, next_); // later than what was seen of the job
  if (!note) lost_ = note.problems();
  if (!note || *note || !whyNone().empty()) return nullptr;
  return newsWait(services_, waiting_, heartbeat);
}

/// Waits for room before it reads.
Result<JobFrame> JobFrames::read(ByteLease& room) {
  const auto note = services_.jobs.note(waiting_.seen.id, next_);
  if (!note) return note.problems();
  const std::size_t bytes = *note ? bytesOf((*note)->pictures).value_or(0) : 0;
  if (!room.growBy(std::min(bytes, services_.replyBytes.total()), waiting_.until, clientGone_)) return noReplyRoom();
  auto frame = services_.jobs.frame(waiting_.seen.id, next_);
  if (!frame) return frame.problems();
  if (!*frame) {
    Problems problems = whyNone();
    return problems.empty() ? Problems{unknownJob(waiting_.seen.id)} : problems;
  }
  return **std::move(frame);
}

DoneFrame JobFrames::next(const std::function<void()>&) {
  DoneFrame done{.index = next_, .room = std::make_unique<ByteLease>(services_.replyBytes, holder_)};
  auto frame = read(*done.room);
  if (!frame) {
    done.problems = frame.problems();
    return done;
  }
  ++next_;
  carried_ = carriedAfter(carried_, frame->note.carried);
  done.carried = carried_;
  done.own = std::move(frame->note.carried);
  done.result.outcome.stages = std::move(frame->note.stages);
  done.pictures = std::move(frame->pictures);
  done.warnings = std::move(frame->note.warnings);
  done.milliseconds = frame->note.milliseconds;
  return done;
}

} // namespace gnomon
