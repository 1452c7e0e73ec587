#include "server/jobs/job_queue.h"

#include <stdexcept>
#include <sys/random.h>

#include "protocol/base/text.h"

namespace gnomon {

std::int64_t unixMilliseconds() {
  using namespace std::chrono;
  return duration_cast<milliseconds>(system_clock::now().time_since_epoch()).count();
}

JobProgress queuedProgress(const NewJob& job) {
  const std::int64_t now = unixMilliseconds();
  return {.id = job.id,
          .key = job.key,
          .scene = job.scene,
          .first = job.first,
          .count = job.count,
          .carried = job.carried,
          .created = now,
          .changed = now};
}

Problem tooManyJobs(std::size_t most) {
  return {ProblemCode::busy, "",
          "This client has as many jobs as the server keeps for one (--max-jobs); those that it removes make room.",
          std::to_string(most) + " jobs", ""};
}

Problem noShareOfJobs(std::size_t most) {
  return {ProblemCode::busy, "",
          "This client, or its network, has its share of the jobs that the server keeps for all; those that it removes "
          "make room.",
          std::to_string(most) + " jobs", ""};
}

Problem noRoomForJobs(std::uint64_t bytes) {
  return {ProblemCode::insufficientStorage, "", "There is no room for further jobs (--job-bytes).",
          std::to_string(bytes) + " bytes", ""};
}

Problem noRoomForFrame(std::uint64_t bytes) {
  return {ProblemCode::insufficientStorage, "", "There was no room for the pictures of all jobs (--job-bytes).",
          std::to_string(bytes) + " bytes", ""};
}

Problem noShareOfBytes(ProblemCode code, std::uint64_t bytes) {
  return {code, "",
          "The jobs of this client, or of its network, have its share of the bytes that the server keeps for all "
          "(--job-bytes); those that it removes make room.",
          std::to_string(bytes) + " bytes", ""};
}

Problem poisonProblem(int index, int deliveries) {
  return {ProblemCode::internal, "",
          "Frame " + std::to_string(index) + " was begun again and again, and never finished.", "",
          std::to_string(deliveries) + " times"};
}

Problem unknownJob(std::string_view id) {
  return {ProblemCode::notFound, "id",
          "There is no job with this id: it was never made, was removed, or is older than --job-age allows.", "",
          asciiExcerpt(id)};
}

std::string newJobId() {
  std::array<std::uint8_t, 16> bytes;
  if (::getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size())) {
    throw std::runtime_error("The system gives no random bytes.");
  }
  return hexText(bytes);
}

} // namespace gnomon
