#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/base/result.h"
#include "protocol/json/json_codec.h"

/// Sequences that are drawn in the background.
/// Rows of the fields: job_rows.h.
namespace gnomon {

enum class JobState { queued, running, done, failed, cancelled };

/// What a job is doing and where its results are.
struct Job {
  std::string id{}; ///< 32 random lower-case hexadecimal digits
  JobState state = JobState::queued;
  std::string scene{};
  std::optional<std::string> key{};
  int first = 0;
  int done = 0;
  int of = 0;
  std::uint64_t bytes = 0;
  std::string created{};
  std::optional<std::string> started{};
  std::optional<std::string> ended{};
  std::string expires{};
  std::vector<Problem> problems{};
  std::string address{}; ///< "/v1/jobs/ID"
  std::string result{};  ///< "/v1/jobs/ID/result"
  std::string frames{};  ///< "/v1/jobs/ID/frames/{index}"
};

/// GET /v1/jobs.
struct JobList {
  std::vector<Job> jobs{};
};

/// The job that a server wrote as JSON; what it says beyond our rows is passed over. Nothing = it is no job.
std::optional<Job> readJob(std::string_view json);

/// The jobs of a list; nothing = it is no such list.
std::optional<JobList> readJobList(std::string_view json);

} // namespace gnomon
