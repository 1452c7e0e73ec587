#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>

#include "server/system/clock.h"
#include "server/system/file_descriptor.h"

namespace gnomon {

/// Lines on their way to a descriptor whose reader may be slow or gone. No caller waits for it: beyond a bound lines
/// are dropped and counted, and a line says how many once the reader goes on. Any thread.
class LineWriter {
 public:
  /// `fd` outlives the writer. `mostBytes` of lines may wait, and as many again may be on their way.
  LineWriter(int fd, std::size_t mostBytes);

  /// Ends at once: what still waits is lost. flush() comes before it.
  ~LineWriter();

  /// Takes one line, without its end, or drops it.
  void put(std::string_view line);

  /// Lines that were dropped since the start.
  std::uint64_t dropped();

  /// Waits until everything is written; false where the deadline came first.
  bool flush(Clock::time_point deadline);

 private:
  void write();
  void writeAll(std::string_view bytes);

  const int fd_;
  const std::size_t mostBytes_;
  StopSignal stop_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::string waiting_; ///< lines, each with its end
  std::uint64_t droppedInAll_ = 0;
  std::size_t dropped_ = 0; ///< lines since the last that was taken
  int flushing_ = 0;        ///< threads that wait for all to be written
  bool writing_ = false;    ///< lines that no longer wait are not written yet
  bool stopping_ = false;
  std::thread thread_;
};

/// Now, in UTC to the millisecond: "2031-05-04T13:02:01.250Z".
std::string timeText();

/// Writes one line to the log, which is standard error. Never throws, never waits.
void logLine(std::string_view line) noexcept;

/// One line about the server itself: {"time": …, "event": …, "detail": …}, and "traceId" where a request caused it.
/// Never throws, never waits.
void logEvent(std::string_view event, std::string_view detail, std::string_view traceId = {}) noexcept;

/// Lines of the log that were dropped, because it was not read.
std::uint64_t logLinesDropped() noexcept;

/// Before the process ends: gives the log's reader this long to take what still waits.
void flushLog(std::chrono::milliseconds patience) noexcept;

} // namespace gnomon
