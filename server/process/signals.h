#pragma once

#include <functional>

#include "server/system/clock.h"
#include "server/system/file_descriptor.h"

namespace gnomon {

/// SIGTERM and SIGINT, received by waiting, and SIGHUP while something is to be read again. Blocks them for the calling
/// thread and those that it starts later.
class Signals {
 public:
  /// `onHangup`: called for each SIGHUP by the thread that waits; nothing = SIGHUP is left alone.
  explicit Signals(std::function<void()> onHangup);

  enum class Event { signal, done, timeout };

  /// Waits for SIGTERM or SIGINT, for `done`, or for the deadline.
  Event wait(const StopSignal& done, Clock::time_point deadline);

 private:
  std::function<void()> onHangup_;
  FileDescriptor signals_;
};

} // namespace gnomon
