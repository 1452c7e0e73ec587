#pragma once

#include <cstddef>

#include "protocol/base/result.h"

namespace gnomon {

/// What the descriptors that the system grants a process are for.
struct DescriptorPlan {
  std::size_t waitingConnections = 0; ///< those that have no request to serve (ConnectionLimits::maxWaiting)
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

} // namespace gnomon
