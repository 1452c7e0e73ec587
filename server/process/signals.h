#pragma once

#include <functional>

#include "server/system/clock.h"
#include "server/system/file_descriptor.h"

namespace gnomon {

/// SIGTERM, SIGINT and SIGHUP, received by waiting, and the end of the process that holds the other end of a pipe.
/// Blocks these signals for the calling thread and those that it starts later.
class Signals {
 public:
  /// `onHangup`: called for each SIGHUP by the thread that waits. `starter`: a pipe's end for reading, whose bytes are
  /// dropped; none = the end of the process that started this one changes nothing.
  explicit Signals(std::function<void()> onHangup, FileDescriptor starter = {});

  enum class Event { signal, abandoned, done, timeout };

  /// Waits for SIGTERM or SIGINT, for the starter's end of the pipe to be closed (reported once), for `done`, or for
  /// the deadline.
  Event wait(const StopSignal& done, Clock::time_point deadline);

 private:
  bool starterIsGone();

  std::function<void()> onHangup_;
  FileDescriptor signals_;
  FileDescriptor starter_;
};

} // namespace gnomon
