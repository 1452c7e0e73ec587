#include "server/http/request_log.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "server/system/log.h"

namespace gnomon {
namespace {

using Line = nlohmann::ordered_json;

std::string dump(const Line& line) {
  return line.dump(-1, ' ', false, Line::error_handler_t::replace); // a client's text need not be UTF-8
}

/// The beginning of a target, without its signature: whoever reads the log could use it.
std::string readableTarget(const std::string& target) {
  constexpr std::size_t kMost = 512;
  return target.substr(0, std::min(kMost, target.find("signature=")));
}

} // namespace

std::string requestLine(const RequestRecord& record, const HttpReply& reply, double milliseconds) {
  Line line{{"event", "request"},
            {"id", record.id},
            {"client", record.client},
            {"method", record.method},
            {"target", readableTarget(record.target)},
            {"status", reply.status},
            {"requestBytes", record.requestBytes},
            {"replyBytes", record.replyBytes},
            {"milliseconds", milliseconds}};
  if (!record.proxy.empty()) {
    line["proxy"] = record.proxy;
  }
  if (!record.trace.traceId.empty()) {
    line["traceId"] = record.trace.traceId;
    line["spanId"] = record.trace.spanId;
  }
  if (!record.trace.parentId.empty()) {
    line["parentId"] = record.trace.parentId;
  }
  if (!reply.key.empty()) {
    line["key"] = reply.key;
  }
  for (const StageTime& stage : reply.stages) {
    line["stages"][stage.stage] = stage.milliseconds;
  }
  if (!record.delivered) {
    line["clientGone"] = true;
  }
  if (!reply.problem.empty()) {
    line["problem"] = reply.problem;
  }
  if (!reply.note.empty()) {
    line["note"] = reply.note;
  }
  return dump(line);
}

void logRequest(const RequestRecord& record, const HttpReply& reply) noexcept {
  try {
    const std::chrono::duration<double, std::milli> took = Clock::now() - record.start;
    std::string line = requestLine(record, reply, took.count());
    line.insert(1, "\"time\":\"" + timeText() + "\",");
    logLine(line);
  } catch (...) {
    // A line that can't be written must not cost the reply.
  }
}

} // namespace gnomon
