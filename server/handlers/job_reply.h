#pragma once

#include <functional>
#include <string>

#include "protocol/job/job.h"
#include "server/handlers/handlers.h"

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

} // namespace gnomon
