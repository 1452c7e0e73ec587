#include "server/handlers/outcome_reply.h"

#include <array>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <utility>

#include "protocol/json/json_codec.h"

namespace gnomon {

RefusalReason refusalOf(TaskRefusal refusal) {
  return refusal == TaskRefusal::queue    ? RefusalReason::queue
         : refusal == TaskRefusal::memory ? RefusalReason::memory
                                          : RefusalReason::none;
}

std::string serverTiming(const std::vector<StageTime>& stages) {
  std::string text;
  for (const StageTime& stage : stages) {
    std::array<char, 32> duration; // longer ones are no times (areStages)
    std::snprintf(duration.data(), duration.size(), "%.3f", stage.milliseconds);
    text.append(text.empty() ? "" : ", ").append(stage.stage).append(";dur=").append(duration.data());
  }
  return text;
}

std::string warningsField(const std::vector<std::string>& warnings) {
  const auto text = [](const Json& list) { return list.dump(-1, ' ', true, Json::error_handler_t::replace); };
  Json list = Json::array();
  for (std::size_t i = 0; i < warnings.size(); ++i) {
    list.push_back(warnings[i]);
    if (text(list).size() <= kMostWarningBytes) continue;
    list.back() = std::to_string(warnings.size() - i) + " more warnings are in the frame's report.";
    break;
  }
  return text(list);
}

std::optional<SharedBytes> bodyOf(TaskResult& result) {
  Problems& problems = result.outcome.problems;
  if (!problems.empty()) return std::nullopt;
  if (!result.body) problems = {{ProblemCode::internal, "", "The worker's reply could not be read.", "", ""}};
  return result.body;
}

HttpReply replyOf(TaskResult result, std::string_view requestId) {
  Outcome& outcome = result.outcome;
  auto body = bodyOf(result);
  if (!outcome.problems.empty()) {
    HttpReply reply = problemReply(outcome.problems, requestId, {.retryAfterSeconds = outcome.retryAfterSeconds});
    reply.note = std::move(outcome.note);
    reply.refusal = refusalOf(result.refusal);
    return reply;
  }
  HttpReply reply;
  reply.contentType = std::move(outcome.contentType);
  reply.body = *std::move(body);
  reply.room = std::move(result.room);
  reply.stages = std::move(outcome.stages);
  if (!reply.stages.empty()) {
    reply.headers.emplace_back("Server-Timing", serverTiming(reply.stages));
    reply.headers.emplace_back("Timing-Allow-Origin", "*");
  }
  if (!outcome.warnings.empty()) reply.headers.emplace_back("Gnomon-Warnings", warningsField(outcome.warnings));
  return reply;
}

} // namespace gnomon
