#pragma once

#include <functional>

#include "protocol/job/job.h"
#include "server/handlers/handlers.h"
#include "server/handlers/sequence_frames.h"
#include "server/jobs/job_queue.h"

/// Replies about jobs.
namespace gnomon {

/// The job as clients see it.
Job jobOf(const JobProgress& progress, std::chrono::seconds age);

/// A job of the client's key. Problems: notFound, also where it is another key's; unavailable.
Result<JobProgress> jobAt(Services& services, const RouteCall& call);

/// A refusal that says when to try again, where its problem passes.
HttpReply jobProblem(const Problems& problems, const RouteCall& call);

/// Waits for news of a job: until it is no more as `seen`, or the time is over, or `gone`. A job that is not there any
/// more is `cancelled`. Problem: unavailable.
Result<JobProgress> newsOf(Services& services, const JobProgress& seen, Clock::time_point until,
                           const std::function<bool()>& gone);

/// The frames of a job, in order, as others draw them.
class JobFrames final : public FrameSource {
 public:
  /// `until`: when waiting ends with a problem.
  JobFrames(Services& services, JobProgress job, Clock::time_point until, Holder holder,
            std::function<bool()> clientGone);

  bool atEnd() const override { return next_ == job_.count; }
  int count() const override { return job_.count; }
  DoneFrame next(const std::function<void()>& waiting) override;

 private:
  Problems await(const std::function<void()>& waiting);
  Result<JobFrame> read(ByteLease& room);

  Services& services_;
  JobProgress job_; ///< as it was last seen
  const Clock::time_point until_;
  const Holder holder_;
  const std::function<bool()> clientGone_;
  int next_;
  Carried carried_; ///< of the frames before the next
};

} // namespace gnomon
