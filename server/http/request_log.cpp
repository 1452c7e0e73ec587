#include "server/http/request_log.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <random>
#include <span>
#include <sys/random.h>
#include <utility>

#include "protocol/access/access_key.h"
#include "protocol/base/text.h"
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

std::string_view nameOf(Delivery delivery) {
  switch (delivery) {
    case Delivery::whole:
      return "";
    case Delivery::clientLeft:
      return "clientLeft";
    case Delivery::tooSlow:
      return "tooSlow";
    case Delivery::othersWaited:
      return "othersWaited";
    case Delivery::shutdown:
      return "shutdown";
  }
  return "";
}

/// Without escapes, also those of escapes; broken ones stay.
std::string withoutEscapes(std::string_view text) {
  constexpr std::size_t kEscape = 3;
  std::string plain;
  for (const char c : text) {
    plain += c;
    while (plain.size() >= kEscape && plain[plain.size() - kEscape] == '%') {
      unsigned byte = 0;
      const char* const end = plain.data() + plain.size();
      if (std::from_chars(end - 2, end, byte, 16).ptr != end) break;
      plain.replace(plain.size() - kEscape, kEscape, 1, static_cast<char>(byte));
    }
  }
  return plain;
}

/// The beginning of a target, up to a part that names a signature in any spelling: readers of the log could use it.
std::string readableTarget(std::string_view target) {
  constexpr std::size_t kMost = 512;
  std::size_t begin = 0;
  while (begin < target.size()) {
    const std::size_t end = std::min(target.find_first_of("&?", begin), target.size());
    if (lowerCase(withoutEscapes(target.substr(begin, end - begin))).find(kSignatureKey) != std::string::npos) break;
    begin = end + 1;
  }
  return std::string(target.substr(0, std::min({kMost, begin, target.size()})));
}

constexpr std::size_t kTraceDigits = 32, kSpanDigits = 16;

bool isHex(std::string_view text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'); });
}

/// An id: lower-case hexadecimal digits, not all of them 0.
bool isId(std::string_view text) {
  return isHex(text) && text.find_first_not_of('0') != std::string_view::npos;
}

/// VERSION-TRACE-PARENT-FLAGS. Of a version after 00 these come first, and more may follow them.
std::optional<TraceContext> parsed(std::string_view text) {
  constexpr std::size_t kTrace = 3, kParent = 36, kFlags = 53, kEnd = 55;
  if (text.size() < kEnd || text[2] != '-' || text[kParent - 1] != '-' || text[kFlags - 1] != '-') return std::nullopt;
  const std::string_view version = text.substr(0, 2);
  const bool isLonger = text.size() > kEnd;
  if (!isHex(version) || version == "ff" || (isLonger && (version == "00" || text[kEnd] != '-'))) return std::nullopt;
  const std::string_view trace = text.substr(kTrace, kTraceDigits);
  const std::string_view parent = text.substr(kParent, kSpanDigits);
  const std::string_view flags = text.substr(kFlags, 2);
  if (!isId(trace) || !isId(parent) || !isHex(flags)) return std::nullopt;
  constexpr std::string_view kOdd = "13579bdf";
  return TraceContext{std::string(trace), "", std::string(parent), kOdd.find(flags[1]) != std::string_view::npos};
}

/// Unpredictable, and never all 0.
std::string newId(std::size_t digits) {
  std::array<std::uint8_t, kTraceDigits / 2> bytes{};
  const std::span<std::uint8_t> used = std::span(bytes).first(digits / 2);
  if (::getrandom(used.data(), used.size(), 0) != static_cast<ssize_t>(used.size())) {
    std::generate(used.begin(), used.end(),
                  [source = std::random_device()]() mutable { return static_cast<std::uint8_t>(source()); });
  }
  used.back() = static_cast<std::uint8_t>(used.back() | 1);
  return hexText(used);
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
  if (record.delivery != Delivery::whole) line.add("undelivered", nameOf(record.delivery));
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

TraceContext traceOf(const Headers& headers) {
  const auto offered = headerValue(headers, "traceparent"); // two of them make a value that is none
  auto trace = offered ? parsed(*offered) : std::nullopt;
  if (!trace) trace = TraceContext{newId(kTraceDigits), "", "", false};
  trace->spanId = newId(kSpanDigits);
  return *std::move(trace);
}

std::string traceResponse(const TraceContext& trace) {
  return "00-" + trace.traceId + "-" + trace.spanId + (trace.sampled ? "-01" : "-00");
}

void addTrace(HttpReply& reply, const TraceContext& trace) {
  if (!trace.traceId.empty()) reply.headers.emplace_back("traceresponse", traceResponse(trace));
}

} // namespace gnomon
