#include "server/handlers/job_frames.h"

#include <algorithm>

#include "protocol/sequence/carry.h"
#include "server/handlers/job_reply.h"
#include "server/jobs/job_problems.h"

namespace gnomon {

JobFrames::JobFrames(Services& services, JobProgress job, Clock::time_point until, std::function<bool()> clientGone)
    : services_(services),
      job_(std::move(job)),
      until_(until),
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
    if (job_.state == JobState::failed) return job_.problems;
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
  const std::size_t bytes = *note ? bytesOf((*note)->pictures) : 0;
  if (!room.growBy(std::min(bytes, services_.replyBytes.total()), until_, clientGone_)) return noReplyRoom();
  auto frame = services_.jobs.frame(job_.id, next_);
  if (!frame) return frame.problems();
  if (!*frame) return unknownJob(job_.id);
  return **std::move(frame);
}

DoneFrame JobFrames::next(const std::function<void()>& waiting) {
  DoneFrame done{.index = next_, .room = std::make_unique<ByteLease>(services_.replyBytes)};
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
  done.pictures = std::move(frame->note.pictures);
  done.bytes = std::move(frame->bytes);
  done.warnings = std::move(frame->note.warnings);
  done.milliseconds = frame->note.milliseconds;
  return done;
}

} // namespace gnomon
