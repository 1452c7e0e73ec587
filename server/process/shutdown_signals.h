#pragma once

#include <chrono>

#include "server/http/socket_io.h"

namespace gnomon {

/// SIGTERM and SIGINT as something to wait for. Blocks both for the calling thread and those that it makes later.
class ShutdownSignals {
 public:
  ShutdownSignals();

  enum class Event { signal, done, timeout };

  /// Waits for the next signal, for `done`, or for the deadline.
  Event wait(const StopSignal& done, Clock::time_point deadline);

 private:
  FileDescriptor signals_;
};

} // namespace gnomon
