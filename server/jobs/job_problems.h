#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "server/jobs/job_queue.h"

/// Common to all queues: problems, and ids.
namespace gnomon {

std::int64_t unixMilliseconds();

/// The progress of a job that has not begun.
JobProgress queuedProgress(const NewJob& job);

Problem tooManyJobs(std::size_t most);            ///< busy: of one client
Problem noRoomForJobs(std::uint64_t bytes);       ///< insufficientStorage: for a new job
Problem noRoomForFrame(std::uint64_t bytes);      ///< insufficientStorage: for the pictures of one in work
Problem poisonProblem(int index, int deliveries); ///< internal: every server that took the frame died
Problem unknownJob(std::string_view id);          ///< notFound

/// 32 lower-case hexadecimal digits, unguessable.
std::string newJobId();

} // namespace gnomon
