#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "server/handlers/handlers.h"
#include "server/jobs/job_news.h"

/// Replies that wait for news of a job, and hold no thread meanwhile.
namespace gnomon {

/// What waits for one job, and its place among all that wait.
struct JobWaiting {
  std::shared_ptr<void> place; ///< never null
  std::shared_ptr<const JobNews::Watched> job;
  JobProgress seen; ///< as the client knows it
  Clock::time_point until;
};

/// For the job of the request. Problem: busy where the client has its share of all that may wait.
Result<JobWaiting> waitingFor(Services& services, const RouteCall& call, JobProgress job, Clock::time_point until);

/// Nothing more becomes of the job.
bool isOver(const JobProgress& job);

/// The job as JSON, once it is over, its time has passed, or the server drains.
HttpReply replyAtEnd(Services& services, const RouteCall& call, JobWaiting waiting,
                     std::function<HttpReply(const JobProgress&)> replyOf);

/// An event for each change of the job, and at last one for its end.
HttpReply eventsOfJob(Services& services, const RouteCall& call, JobWaiting waiting,
                      std::function<std::string(const JobProgress&)> textOf);

/// Any news of the job: the reply then goes on with a thread.
std::shared_ptr<ReplyWait> newsWait(Services& services, JobWaiting waiting, std::string_view heartbeat);

} // namespace gnomon
