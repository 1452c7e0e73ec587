#pragma once

#include <cstdint>
#include <string>

#include "server/system/clock.h"
#include "server/system/file_descriptor.h"

namespace gnomon::redis {

/// A connected socket to a host, or why there is none.
struct Dialled {
  FileDescriptor socket; ///< does not block
  std::string reason{};  ///< where there is none: words for the log
};

/// Connects by TCP to the first address of the host that answers. Ends early once `cut` is raised; nullptr = never.
Dialled dial(const std::string& host, std::uint16_t port, Clock::time_point deadline, const StopSignal* cut);

/// Waits until a descriptor has one of the events of poll(2); false where the deadline comes first or `cut` is raised.
bool waitFor(int fd, short events, Clock::time_point deadline, const StopSignal* cut);

} // namespace gnomon::redis
