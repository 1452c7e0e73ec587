#pragma once

#include "server/system/file_descriptor.h"

namespace gnomon {

/// The descriptor by which a worker process gets its end of the channel.
inline constexpr int kWorkerChannel = 3;

/// Works for the front at the other end of a channel: draws a first frame, reports that it is ready, and carries out
/// orders until that end is closed. Ends the process.
[[noreturn]] void runWorker(FileDescriptor channel);

} // namespace gnomon
