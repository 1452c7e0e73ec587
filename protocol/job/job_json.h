#pragma once

#include <optional>
#include <string_view>

#include "protocol/job/job.h"
#include "protocol/json/json_codec.h"

namespace gnomon {

Json toJson(const Job& job);
Json toJson(const JobList& list);

/// The job that a server wrote as JSON; what it says beyond our rows is passed over. Nothing = it is no job.
std::optional<Job> readJob(std::string_view json);

/// The jobs of a list; nothing = it is no such list.
std::optional<JobList> readJobList(std::string_view json);

} // namespace gnomon
