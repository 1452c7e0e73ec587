#include "server/handlers/job_reply.h"

#include <algorithm>
#include <array>
#include <ctime>
#include <thread>

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

bool isSame(const JobProgress& a, const JobProgress& b) {
  return a.state == b.state && a.done == b.done;
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
  if (progress.started > 0) job.started = timeTextOf(progress.started);
  if (progress.ended > 0) job.ended = timeTextOf(progress.ended);
  return job;
}

Result<JobProgress> jobAt(Services& services, const RouteCall& call) {
  const std::string& id = call.values.at("id");
  auto found = services.jobs.find(id);
  if (!found) return found.problems();
  if (!*found || (*found)->key != call.request.key) return unknownJob(id);
  return **std::move(found);
}

HttpReply jobProblem(const Problems& problems, const RouteCall& call) {
  constexpr int kRetrySeconds = 5;
  const bool isBusy = atLeastOne(problems).front().code == ProblemCode::busy;
  return problemReply(
      problems, call.request.id,
      {.retryAfterSeconds = kRetrySeconds, .refusal = isBusy ? RefusalReason::permits : RefusalReason::none});
}

Result<JobProgress> newsOf(Services& services, const JobProgress& seen, Clock::time_point until,
                           const std::function<bool()>& gone) {
  constexpr std::chrono::milliseconds kShortest{20};
  constexpr std::chrono::milliseconds kLongest{250};
  for (auto pause = kShortest;; pause = std::min(pause * 2, kLongest)) {
    auto found = services.jobs.find(seen.id);
    if (!found) return found.problems();
    if (!*found) {
      JobProgress cancelled = seen;
      cancelled.state = JobState::cancelled;
      return cancelled;
    }
    const bool isOver = Clock::now() >= until || gone() || services.draining;
    if (isOver || !isSame(**found, seen)) return **std::move(found);
    std::this_thread::sleep_for(std::min<Clock::duration>(pause, until - Clock::now()));
  }
}

JobFrames::JobFrames(Services& services, JobProgress job, Clock::time_point until, Holder holder,
                     std::function<bool()> clientGone)
    : services_(services),
      job_(std::move(job)),
      until_(until),
      holder_(std::move(holder)),
      clientGone_(std::move(clientGone)),
      next_(job_.first),
      carried_(job_.carried) {}

/// Why there will be no next frame; none once it is there.
Problems JobFrames::await(const std::function<void()>& waiting) {
  constexpr std::chrono::milliseconds kHeartbeat{5'000};
  while (true) {
    const auto note = services_.jobs.note(job_.id, next_);
    if (!note) return note.problems();
    if (*note) return {};
    if (job_.state == JobState::failed) return atLeastOne(job_.problems);
    if (job_.state == JobState::cancelled || job_.state == JobState::done) return {unknownJob(job_.id)};
    if (services_.draining) return {{ProblemCode::unavailable, "", "The server is shutting down.", "", ""}};
    if (clientGone_()) return {{ProblemCode::unavailable, "", "The client left.", "", ""}};
    if (Clock::now() >= until_) {
      return {{ProblemCode::deadlineExceeded, "",
               "The job was not done in the time of a sequence (--sequence-timeout); it goes on, and may be asked for "
               "again.",
               "", ""}};
    }
    auto news = newsOf(services_, job_, std::min(until_, Clock::now() + kHeartbeat), clientGone_);
    if (!news) return news.problems();
    if (news->done == job_.done && !news->isEnded()) waiting();
    job_ = *std::move(news);
  }
}

/// Waits for room before it reads.
Result<JobFrame> JobFrames::read(ByteLease& room) {
  const auto note = services_.jobs.note(job_.id, next_);
  if (!note) return note.problems();
  const std::size_t bytes = *note ? bytesOf((*note)->pictures).value_or(0) : 0;
  if (!room.growBy(std::min(bytes, services_.replyBytes.total()), until_, clientGone_)) return noReplyRoom();
  auto frame = services_.jobs.frame(job_.id, next_);
  if (!frame) return frame.problems();
  if (!*frame) return unknownJob(job_.id);
  return **std::move(frame);
}

DoneFrame JobFrames::next(const std::function<void()>& waiting) {
  DoneFrame done{.index = next_, .room = std::make_unique<ByteLease>(services_.replyBytes, holder_)};
  done.problems = await(waiting);
  if (!done.problems.empty()) return done;
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
