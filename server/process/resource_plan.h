#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "protocol/base/result.h"
#include "server/process/serve.h"

namespace gnomon {

/// The defaults of the options that say how much may be kept, for a server with so many bytes: each at most a share,
/// and all of them together at most seven eighths.
ServeOptions fittedTo(std::uint64_t memoryBytes);

/// How many workers there are where no number is asked for: a quarter of the cores, since a frame is drawn on all of
/// them, and at least two, so that a long frame leaves one to short ones; but one where memory is short.
std::size_t usualWorkers(int cores, std::uint64_t memoryBytes);

/// What one of `workers` may hold before it is replaced: an equal part of what the process that listens leaves, without
/// what its reader of VDB files may hold.
std::uint64_t workerBytes(const ServeOptions& options, std::size_t workers, std::uint64_t memoryBytes);

/// What the reader of VDB files of a worker with so many bytes may allocate: it has one at a time.
std::uint64_t vdbReaderBytes(std::uint64_t workerBytes);

/// What the descriptors that the system grants a process are for.
struct DescriptorPlan {
  std::size_t waitingConnections = 0; ///< those that have no request to serve (ConnectionLimits::maxWaiting)
  std::size_t waitingReplies = 0;     ///< connections whose replies wait for news of a job
  std::size_t scenesInMemory = 0;     ///< each is a file in memory; 0 where a directory keeps them
  std::size_t jobs = 0;               ///< each has a file for its pictures
};

/// Asks the system for as many descriptors as it allows. How many that are.
std::size_t raiseDescriptorLimit();

/// What needs descriptors.
struct DescriptorUse {
  std::size_t httpThreads = 0; ///< each with a request
  std::size_t workers = 0;     ///< the most that may run
  std::size_t jobFrames = 0;   ///< frames of jobs that are drawn at once
  bool keepsScenesInMemory = false;
};

/// Shares `descriptors` out: first what threads, workers and frames of jobs can need at once, so that none of them
/// meets the limit; then scenes and waiting connections get the rest in equal parts. unavailable where too little is
/// left.
Result<DescriptorPlan> planDescriptors(std::size_t descriptors, const DescriptorUse& use);

/// What an operator has to know of a plan with fewer connections, replies or jobs than a server has where the system
/// grants enough; "" of any other.
std::string shortageOf(const DescriptorPlan& plan, std::size_t descriptors);

} // namespace gnomon
