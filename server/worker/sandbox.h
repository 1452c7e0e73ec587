#pragma once

#include <cstdint>

#include "protocol/base/result.h"

namespace gnomon {

/// What a worker keeps of its rights once it is ready to draw.
enum class Seal {
  full,   ///< memory, threads and its channel
  drivers ///< these, and what graphics drivers need: files and devices
};

/// Closes every descriptor but standard error and the channel. The first thing that a worker does.
void closeInherited();

/// False in a build with the address sanitizer, which allocates what no limit would allow.
bool allocationsAreBounded();

/// Gives up what a worker never needs, for good and for all its threads: no program is executed, no process started,
/// looked into or signalled, no socket opened, no privilege gained or kept; with Seal::full no file opened, either
/// (seccomp(2), capabilities(7)). `memoryBytes`: the most that it should hold; what it may allocate
/// is a quarter more (RLIMIT_DATA), since not all of that is touched; 0 = as much as there is. A call
/// that is not allowed fails with EPERM. unavailable where the system refuses.
Status seal(Seal kind, std::uint64_t memoryBytes);

} // namespace gnomon
