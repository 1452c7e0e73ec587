#include <algorithm>
#include <nlohmann/json.hpp>

#include "protocol/base/text.h"
#include "protocol/job/job.h"
#include "server/handlers/event_reply.h"
#include "server/handlers/handlers.h"
#include "server/handlers/job_reply.h"
#include "server/handlers/job_waits.h"
#include "server/handlers/sequence_forms.h"
#include "server/handlers/work.h"
#include "server/http/negotiation.h"
#include "server/jobs/job_queue.h"

namespace gnomon {
namespace {

constexpr std::array<std::string_view, 2> kJobForms{"application/json", kEventStream};

/// How long the client wants to wait for the job's end: by ?wait=, or by Prefer: wait=, which may ask for more than it
/// gets.
Result<std::chrono::seconds> waitOf(const Services& services, const HttpRequest& request) {
  const auto most = std::chrono::duration_cast<std::chrono::seconds>(services.requestTimeout);
  const auto asked = queryNumber(request.query, "wait", 0, static_cast<int>(most.count()),
                                 "This is no number of seconds for which a job can be waited for.");
  if (!asked) return asked.problems();
  if (*asked) return std::chrono::seconds(**asked);
  return std::min(std::chrono::seconds(preferredWait(request).value_or(0)), most);
}

std::string textOfJob(const Services& services, const JobProgress& progress) {
  return jsonText(toJson(jobOf(progress, services.jobLimits.age)));
}

HttpReply replyOfJob(const Services& services, const JobProgress& progress) {
  HttpReply reply = jsonReply(toJson(jobOf(progress, services.jobLimits.age)));
  reply.headers = {{"Cache-Control", "no-store"}, {"Vary", "Accept"}};
  return reply;
}

/// To HEAD no body is made.
HttpReply headOnly(HttpReply reply, const RouteCall& call) {
  if (call.request.method != "HEAD") return reply;
  reply.stream = {};
  reply.streamed = nullptr;
  reply.bodyOmitted = true;
  return reply;
}

/// As the job's request, which was checked, has it.
Result<double> framesPerSecondOf(Services& services, const std::string& job) {
  const auto request = services.jobs.request(job);
  if (!request) return request.problems();
  if (!*request) return unknownJob(job);
  const Json asked = Json::parse(**request, nullptr, false);
  const bool isSet = asked.is_object() && asked.contains("framesPerSecond") && asked["framesPerSecond"].is_number();
  return isSet ? asked["framesPerSecond"].get<double>() : SequenceRequest{}.framesPerSecond;
}

} // namespace

HttpReply listJobs(Services& services, RouteCall call) {
  const auto found = services.jobs.list(call.request.isAdmin ? std::nullopt : std::optional(call.request.key));
  if (!found) return jobProblem(found.problems(), call);
  JobList list;
  for (const JobProgress& progress : *found) list.jobs.push_back(jobOf(progress, services.jobLimits.age));
  HttpReply reply = jsonReply(toJson(list));
  reply.headers = {{"Cache-Control", "no-store"}};
  return reply;
}

HttpReply getJob(Services& services, RouteCall call) {
  const auto accept = headerValue(call.request.headers, "accept");
  const auto form = preferred(accept, kJobForms);
  if (!form) return problemReply({notAcceptable("A job", accept, kJobForms)}, call.request.id);
  const auto wait = waitOf(services, call.request);
  if (!wait) return problemReply(wait.problems(), call.request.id);
  auto job = jobAt(services, call);
  if (!job) return jobProblem(job.problems(), call);
  const bool isEvents = kJobForms[*form] == kEventStream;
  if (!isEvents && (wait->count() == 0 || isOver(*job))) return replyOfJob(services, *job);
  const auto until = isEvents ? call.request.arrived + services.sequenceTimeout : Clock::now() + *wait;
  auto waiting = waitingFor(services, call, *std::move(job), until);
  if (!waiting) return jobProblem(waiting.problems(), call);
  if (!isEvents) {
    return replyAtEnd(services, call, *std::move(waiting),
                      [&services](const JobProgress& latest) { return replyOfJob(services, latest); });
  }
  const auto textOf = [&services](const JobProgress& latest) { return textOfJob(services, latest); };
  return headOnly(eventsOfJob(services, call, *std::move(waiting), textOf), call);
}

HttpReply deleteJob(Services& services, RouteCall call) {
  const auto job = jobAt(services, call);
  if (!job) return jobProblem(job.problems(), call);
  const auto removed = services.jobs.remove(job->id);
  if (!removed) return jobProblem(removed.problems(), call);
  if (!*removed) return problemReply({unknownJob(job->id)}, call.request.id);
  HttpReply reply;
  reply.status = 204;
  return reply;
}

HttpReply getJobResult(Services& services, RouteCall call) {
  const auto accept = headerValue(call.request.headers, "accept");
  const auto form = preferred(accept, kSequenceForms);
  if (!form) return problemReply({notAcceptable("A job's result", accept, kSequenceForms)}, call.request.id);
  auto job = jobAt(services, call);
  if (!job) return jobProblem(job.problems(), call);
  if (job->state == JobState::failed && job->done == 0) return jobProblem(job->problems, call);
  const auto framesPerSecond = framesPerSecondOf(services, job->id);
  if (!framesPerSecond) return jobProblem(framesPerSecond.problems(), call);
  auto waiting = waitingFor(services, call, *std::move(job), call.request.arrived + services.sequenceTimeout);
  if (!waiting) return jobProblem(waiting.problems(), call);
  auto frames = std::make_shared<JobFrames>(services, *std::move(waiting), holderOf(call.request), call.clientGone);
  const SequenceReport report{.framesPerSecond = *framesPerSecond, .renderer = services.workers.info()};
  return headOnly(
      sequenceReply(sequenceForm(kSequenceForms[*form], call), call, std::move(frames), std::nullopt, report), call);
}

HttpReply getJobFrame(Services& services, RouteCall call) {
  const auto job = jobAt(services, call);
  if (!job) return jobProblem(job.problems(), call);
  const std::string& asked = call.values.at("index");
  const auto index = wholeNumber(asked);
  if (!index || *index < job->first || *index >= job->count) {
    return problemReply({{ProblemCode::notFound, "index", "The job has no frame of this index.",
                          std::to_string(job->first) + ".." + std::to_string(job->count - 1), asciiExcerpt(asked)}},
                        call.request.id);
  }
  const auto note = services.jobs.note(job->id, *index);
  if (!note) return jobProblem(note.problems(), call);
  const Problem notDrawn{ProblemCode::notFound, "index", "This frame is not drawn yet.", "", asciiExcerpt(asked)};
  if (!*note) return problemReply({notDrawn}, call.request.id);
  const std::vector<PictureNews>& pictures = (*note)->pictures;
  const std::array<std::string_view, 1> offers{pictures.size() == 1 ? std::string_view(pictures[0].contentType)
                                                                    : "multipart/mixed"};
  const auto accept = headerValue(call.request.headers, "accept");
  if (!preferred(accept, offers)) return problemReply({notAcceptable("The frame", accept, offers)}, call.request.id);
  const std::string etag = '"' + (*note)->contentKey + '"';
  const Precondition condition = preconditionOf(call.request.headers, etag);
  if (condition == Precondition::failed) {
    return problemReply({preconditionFailed(call.request.headers, etag)}, call.request.id);
  }
  HttpReply reply;
  if (condition != Precondition::holds) {
    reply.status = 304;
  } else {
    ReplyRoom room;
    if (!room.await(services.replyBytes, holderOf(call.request), bytesOf(pictures).value_or(0),
                    Clock::now() + services.replyRoom, call.clientGone)) {
      const int comeAgain = services.replyBytes.retryAfterSeconds();
      return problemReply({noReplyRoom()}, call.request.id, {RequestPart::whole, comeAgain, RefusalReason::memory});
    }
    auto frame = services.jobs.frame(job->id, *index);
    if (!frame) return jobProblem(frame.problems(), call);
    if (!*frame) return problemReply({notDrawn}, call.request.id);
    reply = frameReply({.index = *index, .pictures = std::move((*frame)->pictures)}, call);
    reply.room = std::move(room);
  }
  reply.headers.emplace_back("ETag", etag);
  reply.headers.emplace_back("Cache-Control", "private, no-cache");
  reply.headers.emplace_back("Gnomon-Frame", std::to_string(*index));
  return reply;
}

} // namespace gnomon
