#include "server/handlers/job_reply.h"

#include <algorithm>
#include <array>
#include <ctime>
#include <thread>

#include "server/jobs/job_problems.h"

namespace gnomon {
namespace {

std::string timeTextOf(std::int64_t milliseconds) {
  const auto seconds = static_cast<std::time_t>(milliseconds / 1000);
  std::tm parts{};
  ::gmtime_r(&seconds, &parts);
  std::array<char, 40> text{};
  const std::size_t length = std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &parts);
  return {text.data(), length};
}

bool isSame(const JobProgress& a, const JobProgress& b) {
  return a.state == b.state && a.done == b.done;
}

} // namespace

Job jobOf(const JobProgress& progress, std::chrono::seconds age) {
  const std::string address = "/v1/jobs/" + progress.id;
  Job job{.id = progress.id,
          .state = progress.state,
          .scene = progress.scene,
          .first = progress.first,
          .done = progress.done,
          .of = progress.count - progress.first,
          .bytes = progress.bytes,
          .created = timeTextOf(progress.created),
          .expires = timeTextOf(progress.changed + std::chrono::milliseconds(age).count()),
          .problems = progress.problems,
          .address = address,
          .result = address + "/result",
          .frames = address + "/frames/{index}"};
  if (progress.started > 0) job.started = timeTextOf(progress.started);
  if (progress.ended > 0) job.ended = timeTextOf(progress.ended);
  return job;
}

Result<JobProgress> jobAt(Services& services, const RouteCall& call) {
  const std::string& id = call.values.at("id");
  auto found = services.jobs.find(id);
  if (!found) return found.problems();
  if (!*found || (*found)->key != call.request.key) return unknownJob(id);
  return **std::move(found);
}

HttpReply jobProblem(const Problems& problems, const RouteCall& call) {
  constexpr int kRetrySeconds = 5;
  HttpReply reply = problemReply(problems, call.request.id, {.retryAfterSeconds = kRetrySeconds});
  if (problems.front().code == ProblemCode::busy) reply.refusal = RefusalReason::permits;
  return reply;
}

Result<JobProgress> newsOf(Services& services, const JobProgress& seen, Clock::time_point until,
                           const std::function<bool()>& gone) {
  constexpr std::chrono::milliseconds kShortest{20};
  constexpr std::chrono::milliseconds kLongest{250};
  for (auto pause = kShortest;; pause = std::min(pause * 2, kLongest)) {
    auto found = services.jobs.find(seen.id);
    if (!found) return found.problems();
    if (!*found) {
      JobProgress cancelled = seen;
      cancelled.state = JobState::cancelled;
      return cancelled;
    }
    const bool isOver = Clock::now() >= until || gone() || services.draining;
    if (isOver || !isSame(**found, seen)) return **std::move(found);
    std::this_thread::sleep_for(std::min<Clock::duration>(pause, until - Clock::now()));
  }
}

} // namespace gnomon
