#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "protocol/base/result.h"

/// Sequences that are drawn while nobody waits for them.
namespace gnomon {

enum class JobState {
  queued,   ///< no frame was begun
  running,  ///< some were
  done,     ///< all are drawn
  failed,   ///< one could not be drawn
  cancelled ///< somebody removed it while it was looked at
};

/// What a job is doing and where its results are.
struct Job {
  std::string id{}; ///< 32 lower-case hexadecimal digits that nobody can guess
  JobState state = JobState::queued;
  std::string scene{};                  ///< id of the scene
  int first = 0;                        ///< index of the first frame that is drawn
  int done = 0;                         ///< frames that are drawn
  int of = 0;                           ///< frames that are to be drawn
  std::uint64_t bytes = 0;              ///< of the pictures so far
  std::string created{};                ///< RFC 3339, as all times here
  std::optional<std::string> started{}; ///< when its first frame was begun
  std::optional<std::string> ended{};   ///< when it was done or failed
  std::string expires{};                ///< when it is removed, if nothing more happens to it
  std::vector<Problem> problems{};      ///< why it failed
  std::string address{};                ///< "/v1/jobs/ID"
  std::string result{};                 ///< "/v1/jobs/ID/result"
  std::string frames{};                 ///< "/v1/jobs/ID/frames/{index}"
};

/// GET /v1/jobs.
struct JobList {
  std::vector<Job> jobs{}; ///< the newest first
};

} // namespace gnomon
