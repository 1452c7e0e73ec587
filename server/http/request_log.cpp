#include "server/http/request_log.h"

#include <array>
#include <ctime>
#include <memory>
#include <nlohmann/json.hpp>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

namespace gnomon {
namespace {

using Line = nlohmann::ordered_json;

spdlog::logger& logger() {
  static const std::shared_ptr<spdlog::logger> log = [] {
    auto made = std::make_shared<spdlog::logger>("gnomon", std::make_shared<spdlog::sinks::stderr_sink_mt>());
    made->set_pattern("%v");
    made->flush_on(spdlog::level::info);
    return made;
  }();
  return *log;
}

std::string timeText() {
  std::timespec now{};
  std::timespec_get(&now, TIME_UTC);
  std::tm utc{};
  gmtime_r(&now.tv_sec, &utc);
  std::array<char, 40> text;
  const std::size_t length = std::strftime(text.data(), text.size(), "%FT%T", &utc);
  return fmt::format("{}.{:03}Z", std::string_view(text.data(), length), now.tv_nsec / 1'000'000);
}

std::string dump(const Line& line) {
  return line.dump(-1, ' ', false, Line::error_handler_t::replace); // a client's text need not be UTF-8
}

} // namespace

std::string requestLine(const RequestRecord& record, const HttpReply& reply, double milliseconds) {
  constexpr std::size_t kMostOfTarget = 512;
  Line line{{"event", "request"},
            {"id", record.id},
            {"method", record.method},
            {"target", record.target.substr(0, kMostOfTarget)},
            {"status", reply.status},
            {"requestBytes", record.requestBytes},
            {"replyBytes", reply.body.size()},
            {"milliseconds", milliseconds}};
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
    logger().info("{}", line);
  } catch (...) {
    // A line that can't be written must not cost the reply.
  }
}

void logEvent(std::string_view event, std::string_view detail) noexcept {
  try {
    logger().info("{}", dump(Line{{"time", timeText()}, {"event", event}, {"detail", detail}}));
  } catch (...) {
  }
}

} // namespace gnomon
