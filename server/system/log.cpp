#include "server/system/log.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <ctime>
#include <nlohmann/json.hpp>
#include <poll.h>
#include <unistd.h>
#include <utility>

namespace gnomon {
namespace {

constexpr std::size_t kMostBytes = 1 << 20;
constexpr std::chrono::milliseconds kGather{5}; ///< lines of so long are written at once

std::string eventLine(std::string_view event, std::string_view detail, std::string_view traceId = {}) {
  using Line = nlohmann::ordered_json;
  Line line{{"time", timeText()}, {"event", event}, {"detail", detail}};
  if (!traceId.empty()) line["traceId"] = traceId;
  return line.dump(-1, ' ', false, Line::error_handler_t::replace); // a client's text need not be UTF-8
}

/// Never destroyed: threads that outlive main() may still log.
LineWriter& standardError() {
  static auto* const writer = new LineWriter(STDERR_FILENO, kMostBytes);
  return *writer;
}

} // namespace

LineWriter::LineWriter(int fd, std::size_t mostBytes) : fd_(fd), mostBytes_(mostBytes), thread_([this] { write(); }) {}

LineWriter::~LineWriter() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  changed_.notify_all();
  stop_.raise();
  thread_.join();
}

void LineWriter::put(std::string_view line) {
  bool isFirst = false;
  {
    const std::lock_guard lock(mutex_);
    isFirst = waiting_.empty();
    if (waiting_.size() + line.size() + 1 > mostBytes_) {
      ++dropped_;
      ++droppedInAll_;
      return;
    }
    waiting_.append(line).push_back('\n');
  }
  if (isFirst) changed_.notify_all();
}

std::uint64_t LineWriter::dropped() {
  const std::lock_guard lock(mutex_);
  return droppedInAll_;
}

bool LineWriter::flush(Clock::time_point deadline) {
  std::unique_lock lock(mutex_);
  ++flushing_;
  changed_.notify_all();
  const bool done =
      changed_.wait_until(lock, deadline, [this] { return waiting_.empty() && dropped_ == 0 && !writing_; });
  --flushing_;
  return done;
}

void LineWriter::write() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return stopping_ || !waiting_.empty() || dropped_ > 0; });
    changed_.wait_for(lock, kGather, [this] { return stopping_ || flushing_ > 0; });
    if (stopping_) return;
    std::string lines = std::exchange(waiting_, {});
    const std::size_t dropped = std::exchange(dropped_, 0);
    writing_ = true;
    lock.unlock();
    if (dropped > 0) {
      lines += eventLine("log", std::to_string(dropped) + " lines were dropped because the log was not read.") + "\n";
    }
    writeAll(lines);
    lock.lock();
    writing_ = false;
    changed_.notify_all();
  }
}

/// What the descriptor refuses is lost: there is no other place to report it.
void LineWriter::writeAll(std::string_view bytes) {
  constexpr std::size_t kAtomic = 4096; // a pipe that is ready takes so much without making the writer wait
  while (!bytes.empty()) {
    std::array<pollfd, 2> waiting{{{fd_, POLLOUT, 0}, {stop_.fd(), POLLIN, 0}}};
    if (::poll(waiting.data(), waiting.size(), -1) < 0) continue;
    if (waiting[1].revents != 0) return;
    const ssize_t count = ::write(fd_, bytes.data(), std::min(bytes.size(), kAtomic));
    if (count > 0) {
      bytes.remove_prefix(static_cast<std::size_t>(count));
    } else if (errno != EAGAIN && errno != EINTR) {
      return;
    }
  }
}

std::string timeText() {
  std::timespec now{};
  std::timespec_get(&now, TIME_UTC);
  std::tm utc{};
  gmtime_r(&now.tv_sec, &utc);
  std::array<char, 32> text;
  const std::size_t length = std::strftime(text.data(), text.size(), "%FT%T", &utc);
  std::array<char, 8> milliseconds;
  std::snprintf(milliseconds.data(), milliseconds.size(), ".%03dZ", static_cast<int>(now.tv_nsec / 1'000'000));
  return std::string(text.data(), length) + milliseconds.data();
}

void logLine(std::string_view line) noexcept {
  try {
    standardError().put(line);
  } catch (...) {
    // A line that can't be written must not cost the reply.
  }
}

void logEvent(std::string_view event, std::string_view detail, std::string_view traceId) noexcept {
  try {
    standardError().put(eventLine(event, detail, traceId));
  } catch (...) {
  }
}

std::uint64_t logLinesDropped() noexcept {
  return standardError().dropped();
}

void flushLog(std::chrono::milliseconds patience) noexcept {
  try {
    standardError().flush(Clock::now() + patience);
  } catch (...) {
  }
}

} // namespace gnomon
