#pragma once

#include <cstdint>

#include "protocol/base/result.h"

namespace gnomon {

/// What a worker keeps of its rights once it is ready to draw.
enum class Seal {
  full,   ///< memory, threads and its channel
  drivers ///< these, and what graphics drivers need: the files of confineFiles, devices, and code that they make
};

/// Closes every descriptor but standard error and the channel. The first thing that a worker does.
void closeInherited();

/// False in a build with the address sanitizer, which allocates what no limit would allow.
bool allocationsAreBounded();

/// Leaves this process, and what it starts, the files that drawing takes: programs and libraries, the system's
/// descriptions of drivers, cores and devices, and the devices themselves, which alone may be written. No file is made,
/// and drivers are asked to keep no cache: the code in one runs in the next worker, before that is sealed. No process
/// of the same user reads this one, either. Call it before drivers are loaded and threads started. False where the
/// system has no Landlock: then a worker with a driver reads, and changes, what its user may. unavailable where the
/// system refuses.
Result<bool> confineFiles();

/// Gives up what a worker never needs, for good and for all its threads: no program is executed, no process started,
/// looked into, scheduled or signalled, no socket opened, no privilege gained or kept; with Seal::full no file opened,
/// either, and no code made. `memoryBytes`: above it the process is killed, so that what it may allocate ends before
/// (dataWithin); 0 = as much as there is. A call that is not allowed fails with EPERM. unavailable where the system
/// refuses.
Status seal(Seal kind, std::uint64_t memoryBytes);

} // namespace gnomon
