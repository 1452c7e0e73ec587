#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "protocol/base/text.h"
#include "protocol/cost/frame_cost.h"
#include "protocol/job/job.h"
#include "protocol/sequence/sequence.h"
#include "protocol/spec/traits.h"
#include "server/handlers/handlers.h"
#include "server/handlers/job_reply.h"
#include "server/handlers/sequence_forms.h"
#include "server/handlers/video_form.h"
#include "server/handlers/work.h"
#include "server/http/negotiation.h"
#include "server/jobs/job_queue.h"

namespace gnomon {
namespace {

constexpr int kSequenceRetrySeconds = 1; ///< where the most sequences run: one may be left at any time

constexpr auto kFormsOrVideo = [] {
  std::array<std::string_view, kSequenceForms.size() + 1> types;
  std::copy(kSequenceForms.begin(), kSequenceForms.end(), types.begin());
  types.back() = kVideoType;
  return types;
}();

HttpReply refusal(Problem problem, RefusalReason reason, const std::string& requestId) {
  return problemReply({std::move(problem)}, requestId, {.retryAfterSeconds = kSequenceRetrySeconds, .refusal = reason});
}

/// A sequence that was asked for, and an estimate of its work.
struct AskedSequence {
  Sequence sequence{};
  SceneCounts counts{};
  double ofAll = 0;     ///< milliseconds
  double ofLongest = 0; ///< milliseconds
  FrameSizes sizes{};
  bool isChained = false;
};

/// Whether the frame's shadows may depend on the frame before it: the scene's own lights may be directional, too.
bool mayCarry(const FrameSpec& spec) {
  return !spec.lights || std::any_of(spec.lights->begin(), spec.lights->end(),
                                     [](const Light& light) { return traitsOf(light.type).parallel; });
}

Result<AskedSequence> read(Services& services, const RouteCall& call) {
  AskedSequence asked{.counts = services.store.counts(call.values.at("id")).value_or(SceneCounts())};
  auto sequence = decodeSequence(asText(call.request.body), [&](const FrameSpec& spec) {
    const double estimate = services.workers.milliseconds(spec, asked.counts);
    asked.ofAll += estimate;
    asked.ofLongest = std::max(asked.ofLongest, estimate);
    asked.sizes.see(spec);
    asked.isChained = asked.isChained || mayCarry(spec);
  });
  if (!sequence) return sequence.problems();
  asked.sequence = *std::move(sequence);
  asked.isChained = asked.isChained && asked.sequence.stable;
  return asked;
}

/// Why a frame can't be done in time.
std::optional<Problem> tooLongFrame(const Services& services, const AskedSequence& asked) {
  const auto each = static_cast<double>(services.requestTimeout.count());
  if (asked.ofLongest <= each * kDoubt) return std::nullopt;
  return Problem{ProblemCode::tooLarge, "",
                 "One of the frames is more work than can be done in the time of a frame (--request-timeout).",
                 secondsText(each), "about " + secondsText(asked.ofLongest)};
}

/// Why the frames can't be done in time.
std::optional<Problem> tooMuchWork(const Services& services, const AskedSequence& asked) {
  if (auto problem = tooLongFrame(services, asked)) return problem;
  const auto all = static_cast<double>(services.sequenceTimeout.count());
  if (asked.ofAll <= all * kDoubt) return std::nullopt;
  return Problem{ProblemCode::tooLarge, "",
                 "The frames are more work together than can be done in the time of a sequence (--sequence-timeout).",
                 secondsText(all), "about " + secondsText(asked.ofAll)};
}

/// A job for the sequence, and where it is.
HttpReply putJob(Services& services, const RouteCall& call, const AskedSequence& asked) {
  const NewJob job{.id = newJobId(),
                   .key = call.request.key,
                   .client = call.request.client,
                   .scene = call.values.at("id"),
                   .request = std::string(asText(call.request.body)),
                   .first = asked.sequence.first,
                   .count = asked.sequence.count,
                   .isChained = asked.isChained,
                   .carried = asked.sequence.carried};
  if (const auto kept = services.jobs.put(job); !kept) return jobProblem(kept.problems(), call);
  const Job described = jobOf(queuedProgress(job), services.jobLimits.age);
  HttpReply reply = jsonReply(toJson(described), 202);
  reply.headers = {{"Location", described.address},
                   {"Preference-Applied", "respond-async"},
                   {"Vary", "Prefer"},
                   {"Cache-Control", "no-store"}};
  return reply;
}

} // namespace

HttpReply postSequence(Services& services, RouteCall call) {
  const std::string& id = call.values.at("id");
  const std::string requestId = call.request.id;
  if (const auto used = services.store.use(id); !used) return problemReply(used.problems(), requestId);
  const auto accept = headerValue(call.request.headers, "accept");
  const auto form = preferred(accept, kFormsOrVideo);
  if (!form) return problemReply({notAcceptable("A sequence", accept, kFormsOrVideo)}, requestId);
  const std::string_view type = kFormsOrVideo[*form];
  const bool isVideo = type == kVideoType;
  // Reading one may take seconds: it needs a place, too.
  const Permit permit = permitOf(services.sequences);
  if (!permit) {
    return refusal({ProblemCode::busy, "", "The most sequences that may run at once are running.", "", ""},
                   RefusalReason::permits, requestId);
  }
  auto asked = read(services, call);
  if (!asked) return problemReply(asked.problems(), requestId);
  if (auto problem = asked->sizes.problem(asked->sequence); problem && isVideo) {
    return problemReply({*std::move(problem)}, requestId);
  }
  const bool isJob = prefersAsync(call.request) && !isVideo; // jobs keep pictures, which nothing here decodes
  if (auto problem = isJob ? tooLongFrame(services, *asked) : tooMuchWork(services, *asked)) {
    return refusal(*std::move(problem), RefusalReason::cost, requestId);
  }
  if (isJob) return putJob(services, call, *asked);
  auto bundle = services.store.bundle(id);
  if (!bundle) return problemReply(bundle.problems(), requestId);
  call.request.body = Bytes();
  Task task = taskFor(call, OrderKind::sequenceFrame, id, *std::move(bundle), {}, services.sequenceTimeout);
  task.lane = Lane::sequence;
  if (isVideo) task.order.mediaType = kRawVideo;
  const Sequence& sequence = asked->sequence;
  const VideoSettings settings{sequence.framesPerSecond, sequence.videoQuality, sequence.count - sequence.first};
  const SequenceReport report{.framesPerSecond = settings.framesPerSecond, .renderer = services.workers.info()};
  auto frames = std::make_shared<SequenceFrames>(services, std::move(asked->sequence), asked->counts, std::move(task),
                                                 permit, call.clientGone);
  std::optional<DoneFrame> first;
  if (type != kEventStream) { // what the scene can't meet is then a refusal with its own status
    first = frames->next([] {});
    if (!first->problems.empty()) {
      first->result.outcome.problems = first->problems;
      return replyOf(std::move(first->result), requestId);
    }
  }
  if (!isVideo) return sequenceReply(sequenceForm(type, call), call, std::move(frames), std::move(first), report);
  auto video = videoForm(settings, *first, services.videoMemory, holderOf(call.request));
  if (!video) return refusal(video.problems().front(), RefusalReason::memory, requestId);
  HttpReply reply = sequenceReply(*std::move(video), call, std::move(frames), std::move(first), report);
  reply.memory = &services.videoMemory;
  return reply;
}

} // namespace gnomon
