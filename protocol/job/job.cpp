#include "protocol/job/job.h"

namespace gnomon {

std::optional<Job> readJob(std::string_view json) {
  return readReply<Job>(json, {"id", "state"});
}

std::optional<JobList> readJobList(std::string_view json) {
  return readReply<JobList>(json, {"jobs"});
}

} // namespace gnomon
