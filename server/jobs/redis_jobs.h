#pragma once

#include "server/jobs/job_queue.h"
#include "server/redis/redis.h"

namespace gnomon {

/// A queue in Redis, shared by all servers that name it: jobs outlive each of them. The frames of a job wait in a
/// stream with one consumer group (job_scripts.h). A server that stops renewing loses its frames; times are Redis time.
class RedisJobs final : public JobQueue {
 public:
  RedisJobs(JobLimits limits, std::shared_ptr<redis::Redis> redis);

  Status put(const NewJob& job) override;
  Result<std::optional<FrameTurn>> take(std::chrono::milliseconds patience) override;
  Result<std::optional<std::string>> request(const std::string& job) override;
  Result<bool> renew(const FrameTurn& turn) override;
  Status finish(const FrameTurn& turn, const JobFrame& frame) override;
  Status fail(const FrameTurn& turn, const Problems& problems) override;
  Status giveBack(const FrameTurn& turn, bool isTried) override;
  Result<std::optional<JobProgress>> find(const std::string& job) override;
  Result<std::vector<JobProgress>> list(const std::optional<std::string>& key) override;
  Result<std::optional<FrameNote>> note(const std::string& job, int index) override;
  Result<std::optional<JobFrame>> frame(const std::string& job, int index) override;
  Result<bool> remove(const std::string& job) override;
  Result<JobsSize> size() override;

 private:
  Result<redis::Reply> run(const redis::Script& script, const std::vector<std::string>& arguments) const;
  Result<redis::Reply> ask(const redis::Command& command, std::size_t mostBytes) const;
  std::string age() const { return std::to_string(std::chrono::milliseconds(limits_.age).count()); }
  std::string lease() const { return std::to_string(limits_.lease.count()); }

  const JobLimits limits_;
  const std::shared_ptr<redis::Redis> redis_;
  const std::string consumer_; ///< this process among the takers
};

} // namespace gnomon
