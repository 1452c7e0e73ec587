#include "server/handlers/job_waits.h"

#include <utility>

#include "server/handlers/event_reply.h"
#include "server/handlers/job_reply.h"

namespace gnomon {
namespace {

constexpr std::string_view kComment = ":\n\n"; ///< which event streams pass over

class JobWait : public ReplyWait {
 public:
  JobWait(const Services& services, JobWaiting waiting) : waiting_(std::move(waiting)), services_(services) {}

  void wakeBy(const std::shared_ptr<StopSignal>& news) override { waiting_.job->wakeBy(news); }

 protected:
  bool isTimeOver() const { return services_.draining || Clock::now() >= waiting_.until; }

  JobWaiting waiting_;

 private:
  const Services& services_;
};

class EndWait final : public JobWait {
 public:
  using JobWait::JobWait;

  News look() override {
    const auto latest = waiting_.job->latest();
    const bool isThere = !*latest || isOver(**latest) || isTimeOver();
    return {.next = isThere ? Next::thread : Next::wait};
  }
};

class NewsWait final : public JobWait {
 public:
  NewsWait(const Services& services, JobWaiting waiting, std::string_view heartbeat)
      : JobWait(services, std::move(waiting)), heartbeat_(heartbeat) {}

  News look() override {
    const auto latest = waiting_.job->latest();
    const bool isThere = !*latest || !isSame(**latest, waiting_.seen) || isTimeOver();
    return {.next = isThere ? Next::thread : Next::wait};
  }
  std::string_view heartbeat() const override { return heartbeat_; }

 private:
  const std::string heartbeat_;
};

class EventsWait final : public JobWait {
 public:
  EventsWait(const Services& services, JobWaiting waiting, std::function<std::string(const JobProgress&)> textOf,
             std::shared_ptr<StreamResult> result, std::string requestId)
      : JobWait(services, std::move(waiting)),
        textOf_(std::move(textOf)),
        result_(std::move(result)),
        requestId_(std::move(requestId)) {}

  News look() override {
    const auto latest = waiting_.job->latest();
    if (!*latest) {
      result_->problem = latest->problems().front().detail;
      return {eventText("problem", problemText(latest->problems(), requestId_)), Next::end};
    }
    if (isOver(**latest)) return {eventText("result", textOf_(**latest)), Next::end};
    if (isTimeOver()) return {.next = Next::end};
    if (isSame(**latest, waiting_.seen)) return {};
    waiting_.seen = **latest;
    return {eventText("progress", textOf_(waiting_.seen))};
  }
  std::string_view heartbeat() const override { return kComment; }

 private:
  const std::function<std::string(const JobProgress&)> textOf_;
  const std::shared_ptr<StreamResult> result_;
  const std::string requestId_;
};

} // namespace

bool isOver(const JobProgress& job) {
  return job.isEnded() || job.state == JobState::cancelled;
}

Result<JobWaiting> waitingFor(Services& services, const RouteCall& call, JobProgress job, Clock::time_point until) {
  auto place = services.waits.place(call.request.client);
  if (!place) {
    return Problem{ProblemCode::busy, "",
                   "This client, or its network, has its share of the replies that may wait for jobs.",
                   std::to_string(services.waits.capacity()) + " of all clients", ""};
  }
  auto watched = services.jobNews.watch(job);
  return JobWaiting{std::move(place), std::move(watched), std::move(job), until};
}

HttpReply replyAtEnd(Services& services, const RouteCall& call, JobWaiting waiting,
                     std::function<HttpReply(const JobProgress&)> replyOf) {
  HttpReply reply;
  reply.later = [job = waiting.job, replyOf = std::move(replyOf), call] {
    const auto latest = job->latest();
    return *latest ? replyOf(**latest) : jobProblem(latest->problems(), call);
  };
  reply.wait = std::make_shared<EndWait>(services, std::move(waiting));
  return reply;
}

HttpReply eventsOfJob(Services& services, const RouteCall& call, JobWaiting waiting,
                      std::function<std::string(const JobProgress&)> textOf) {
  HttpReply reply = eventStream();
  const auto result = std::make_shared<StreamResult>();
  reply.streamed = result;
  reply.stream =
      [first = eventText("progress", textOf(waiting.seen)),
       wait = std::make_shared<EventsWait>(services, std::move(waiting), std::move(textOf), result, call.request.id)](
          const BodySink& sink) -> std::shared_ptr<ReplyWait> {
    if (!sink(first)) return nullptr;
    return wait;
  };
  return reply;
}

std::shared_ptr<ReplyWait> newsWait(Services& services, JobWaiting waiting, std::string_view heartbeat) {
  return std::make_shared<NewsWait>(services, std::move(waiting), heartbeat);
}

} // namespace gnomon
