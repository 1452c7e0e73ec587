#include "server/http/request_log.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "server/system/log.h"

namespace gnomon {
namespace {

/// An object's text, member by member: a line is written for each request, and a tree of values would cost more than
/// many of them.
class LineText {
 public:
  void add(std::string_view name, std::string_view value) {
    begin(name);
    addText(value);
  }

  void add(std::string_view name, double value) {
    begin(name);
    std::array<char, 32> digits;
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
    text_.append(digits.data(), end);
  }

  void add(std::string_view name, std::size_t value) {
    begin(name);
    text_ += std::to_string(value);
  }

  void addTrue(std::string_view name) {
    begin(name);
    text_ += "true";
  }

  void add(std::string_view name, const LineText& members) {
    begin(name);
    text_ += members.text_ + '}';
  }

  std::string done() && { return std::move(text_) + '}'; }

 private:
  void begin(std::string_view name) { text_.append(text_.size() == 1 ? "\"" : ",\"").append(name).append("\":"); }

  void addText(std::string_view value) {
    const auto isPlain = [](char c) { return c >= 0x20 && c < 0x7f && c != '"' && c != '\\'; };
    if (std::all_of(value.begin(), value.end(), isPlain)) {
      text_.append("\"").append(value).append("\"");
    } else { // a client's text need not be UTF-8
      text_ += nlohmann::json(value).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    }
  }

  std::string text_ = "{";
};

/// The beginning of a target, without its signature: readers of the log could use it.
std::string readableTarget(const std::string& target) {
  constexpr std::size_t kMost = 512;
  return target.substr(0, std::min(kMost, target.find("signature=")));
}

} // namespace

std::string requestLine(const RequestRecord& record, const HttpReply& reply, double milliseconds) {
  LineText line;
  line.add("event", "request");
  line.add("id", record.id);
  line.add("client", record.client);
  line.add("method", record.method);
  line.add("target", readableTarget(record.target));
  line.add("status", static_cast<std::size_t>(reply.status));
  line.add("requestBytes", record.requestBytes);
  line.add("replyBytes", record.replyBytes);
  line.add("milliseconds", milliseconds);
  const auto addIfAny = [&line](std::string_view name, const std::string& value) {
    if (!value.empty()) line.add(name, value);
  };
  addIfAny("proxy", record.proxy);
  if (!record.trace.traceId.empty()) {
    line.add("traceId", record.trace.traceId);
    line.add("spanId", record.trace.spanId);
  }
  addIfAny("parentId", record.trace.parentId);
  addIfAny("key", reply.key);
  if (!reply.stages.empty()) {
    LineText stages;
    for (const StageTime& stage : reply.stages) stages.add(stage.stage, stage.milliseconds);
    line.add("stages", stages);
  }
  if (!record.delivered) line.addTrue("clientGone");
  addIfAny("problem", reply.problem);
  addIfAny("note", reply.note);
  return std::move(line).done();
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
