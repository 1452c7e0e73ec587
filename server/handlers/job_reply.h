#pragma once

#include <functional>

#include "protocol/job/job.h"
#include "server/handlers/handlers.h"
#include "server/handlers/job_waits.h"
#include "server/handlers/sequence_frames.h"
#include "server/jobs/job_queue.h"

/// Replies about jobs.
namespace gnomon {

/// The job as clients see it.
Job jobOf(const JobProgress& progress, std::chrono::seconds age);

/// A job of the client's key, or any where that has the scope admin. Problems: notFound, also where it is another
/// key's; unavailable.
Result<JobProgress> jobAt(Services& services, const RouteCall& call);

/// A refusal that says when to try again, where its problem passes.
HttpReply jobProblem(const Problems& problems, const RouteCall& call);

/// The frames of a job, in order, as others draw them.
class JobFrames final : public FrameSource {
 public:
  JobFrames(Services& services, JobWaiting waiting, Holder holder, std::function<bool()> clientGone);

  bool atEnd() const override { return next_ == waiting_.seen.count; }
  int count() const override { return waiting_.seen.count; }
  std::shared_ptr<ReplyWait> wait(std::string_view heartbeat) override;
  DoneFrame next(const std::function<void()>& waiting) override;

 private:
  Problems whyNone() const;
  Result<JobFrame> read(ByteLease& room);

  Services& services_;
  JobWaiting waiting_; ///< its end is that of the time for all frames
  const Holder holder_;
  const std::function<bool()> clientGone_;
  int next_;
  Problems lost_{}; ///< of the queue, which does not answer
  Carried carried_; ///< of the frames before the next
};

} // namespace gnomon
