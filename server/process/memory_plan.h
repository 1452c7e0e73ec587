#pragma once

#include <cstdint>

#include "server/process/serve.h"

namespace gnomon {

/// The defaults of the options that say how much may be kept, for a server with so many bytes: each at most a share,
/// and all of them together at most seven eighths.
ServeOptions fittedTo(std::uint64_t memoryBytes);

/// How many workers there are where no number is asked for: a quarter of the cores, since a frame is drawn on all of
/// them, and at least two, so that a long frame leaves one to short ones; but one where memory is short.
std::size_t usualWorkers(int cores, std::uint64_t memoryBytes);

/// What one of `workers` may hold before it is replaced: an equal part of what the process that listens leaves.
std::uint64_t workerBytes(const ServeOptions& options, std::size_t workers, std::uint64_t memoryBytes);

} // namespace gnomon
