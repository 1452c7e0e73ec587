#include "server/http/trace_context.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <random>
#include <span>
#include <string_view>
#include <sys/random.h>

namespace gnomon {
namespace {

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
