#pragma once

#include "server/handlers/sequence_frames.h"
#include "server/jobs/job_queue.h"

namespace gnomon {

/// The frames of a job, in order, as others draw them.
class JobFrames final : public FrameSource {
 public:
  /// `until`: when waiting ends with a problem.
  JobFrames(Services& services, JobProgress job, Clock::time_point until, std::function<bool()> clientGone);

  bool atEnd() const override { return next_ == job_.count; }
  int count() const override { return job_.count; }
  DoneFrame next(const std::function<void()>& waiting) override;

 private:
  Problems await(const std::function<void()>& waiting);
  Result<JobFrame> read(ByteLease& room);

  Services& services_;
  JobProgress job_; ///< as it was last seen
  const Clock::time_point until_;
  const std::function<bool()> clientGone_;
  int next_;
  Carried carried_; ///< of the frames before the next
};

} // namespace gnomon
