#include "server/handlers/sequence_reply.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "protocol/base/elapsed.h"
#include "protocol/sequence/sequence_json.h"
#include "server/handlers/event_reply.h"

namespace gnomon {
namespace {

/// Adds a frame to the report.
void note(const DoneFrame& frame, SequenceReport& report) {
  constexpr std::size_t kMostWarnings = 32;
  report.frames.push_back({frame.index, frame.milliseconds, frame.result.outcome.stages});
  report.carried = frame.carried;
  for (const std::string& warning : frame.warnings) {
    const bool isKnown = std::find(report.warnings.begin(), report.warnings.end(), warning) != report.warnings.end();
    if (!isKnown && report.warnings.size() < kMostWarnings) report.warnings.push_back(warning);
  }
}

/// Sends everything. Returns what became of it.
StreamResult sendAllFrames(SequenceForm& form, const BodySink& sink, FrameSource& frames,
                           std::optional<DoneFrame> first, SequenceReport report, const std::string& requestId) {
  const auto start = Clock::now();
  const double before = first ? first->milliseconds : 0;
  bool isThere = form.begin(sink);
  while (isThere) {
    DoneFrame frame =
        first ? *std::exchange(first, std::nullopt) : frames.next([&] { isThere = form.waiting(sink) && isThere; });
    if (frame.problems.empty())
      if (auto encoded = form.encode(frame); !encoded) frame.problems = encoded.problems();
    if (!frame.problems.empty()) {
      form.problem(sink, problemText(frame.problems, requestId));
      StreamResult ended{.problem = frame.problems.front().detail};
      ended.refusal = refusalOfStatus(statusOf(frame.problems.front().code));
      return ended;
    }
    note(frame, report);
    isThere = form.frame(sink, frame, frames.count()) && isThere;
    if (isThere && frames.atEnd()) {
      report.milliseconds = before + millisecondsSince(start);
      form.report(sink, jsonText(toJson(report)));
      return {};
    }
  }
  return {.problem = "The client left."};
}

} // namespace

HttpReply sequenceReply(TypedForm form, const RouteCall& call, std::shared_ptr<FrameSource> frames,
                        std::optional<DoneFrame> first, SequenceReport report) {
  HttpReply reply;
  reply.contentType = std::move(form.contentType);
  reply.headers.emplace_back("X-Accel-Buffering", "no");   // asks proxies to pass frames on at once
  reply.headers.emplace_back("Cache-Control", "no-store"); // it contains times
  reply.headers.emplace_back("Vary", "Accept");
  const auto result = std::make_shared<StreamResult>();
  reply.streamed = result;
  const auto waited = std::make_shared<std::optional<DoneFrame>>(std::move(first));
  reply.stream = [form = std::move(form.form), frames = std::move(frames), waited, result, report = std::move(report),
                  requestId = call.request.id](const BodySink& sink) {
    *result = sendAllFrames(*form, sink, *frames, std::exchange(*waited, std::nullopt), report, requestId);
  };
  return reply;
}

} // namespace gnomon
