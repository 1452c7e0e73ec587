#include <algorithm>
#include <nlohmann/json.hpp>

#include "protocol/base/text.h"
#include "protocol/cost/frame_cost.h"
#include "protocol/sequence/sequence_json.h"
#include "server/handlers/handlers.h"
#include "server/handlers/sequence_reply.h"
#include "server/handlers/work.h"
#include "server/http/negotiation.h"

namespace gnomon {
namespace {

constexpr int kSequenceRetrySeconds = 10; ///< where the most sequences run

HttpReply refusal(Problem problem, RefusalReason reason, const std::string& requestId) {
  HttpReply reply = problemReply({std::move(problem)}, requestId, {.retryAfterSeconds = kSequenceRetrySeconds});
  reply.refusal = reason;
  return reply;
}

/// Why the frames can't be done in time.
std::optional<Problem> tooMuchWork(const Services& services, double ofAll, double ofLongest) {
  const auto all = static_cast<double>(services.sequenceTimeout.count());
  const auto each = static_cast<double>(services.requestTimeout.count());
  if (ofLongest > each * kDoubt) {
    return Problem{ProblemCode::tooLarge, "",
                   "One of the frames is more work than can be done in the time of a frame (--request-timeout).",
                   secondsText(each), "about " + secondsText(ofLongest)};
  }
  if (ofAll <= all * kDoubt) return std::nullopt;
  return Problem{ProblemCode::tooLarge, "",
                 "The frames are more work together than can be done in the time of a sequence (--sequence-timeout).",
                 secondsText(all), "about " + secondsText(ofAll)};
}

} // namespace

HttpReply postSequence(Services& services, RouteCall call) {
  const std::string& id = call.values.at("id");
  const std::string requestId = call.request.id;
  if (const auto used = services.store.use(id); !used) return problemReply(used.problems(), requestId);
  const auto accept = headerValue(call.request.headers, "accept");
  const auto form = preferred(accept, kSequenceForms);
  if (!form) return problemReply({notAcceptable("A sequence", accept, kSequenceForms)}, requestId);
  // Reading one may take seconds: it needs a place, too.
  const Permit permit = permitOf(services.sequences);
  if (!permit) {
    return refusal({ProblemCode::busy, "", "The most sequences that may run at once are running.", "", ""},
                   RefusalReason::permits, requestId);
  }
  const SceneCounts counts = services.store.counts(id).value_or(SceneCounts());
  double ofAll = 0;
  double ofLongest = 0;
  auto sequence = decodeSequence(asText(call.request.body), [&](const FrameSpec& spec) {
    const double estimate = services.workers.milliseconds(frameCost(spec, counts));
    ofAll += estimate;
    ofLongest = std::max(ofLongest, estimate);
  });
  if (!sequence) return problemReply(sequence.problems(), requestId);
  if (auto problem = tooMuchWork(services, ofAll, ofLongest)) {
    return refusal(*std::move(problem), RefusalReason::cost, requestId);
  }
  auto bundle = services.store.bundle(id);
  if (!bundle) return problemReply(bundle.problems(), requestId);
  call.request.body = Bytes();
  Task task = taskFor(call, OrderKind::sequenceFrame, id, *std::move(bundle), {}, services.sequenceTimeout);
  task.lane = Lane::sequence;
  auto frames = std::make_shared<SequenceFrames>(services, *std::move(sequence), counts, std::move(task), permit,
                                                 call.clientGone);
  std::optional<DoneFrame> first;
  if (kSequenceForms[*form] != kEventStream) { // what the scene can't meet is then a refusal with its own status
    first = frames->next([] {});
    if (!first->problems.empty()) {
      first->result.outcome.problems = first->problems;
      return replyOf(std::move(first->result), requestId);
    }
  }
  return sequenceReply(kSequenceForms[*form], call, std::move(frames), std::move(first), services.workers.info());
}

} // namespace gnomon
