#include "server/process/descriptor_plan.h"

#include <algorithm>
#include <string>
#include <sys/resource.h>

#include "server/process/admin_address.h"

namespace gnomon {
namespace {

constexpr std::size_t kProcess = 60; ///< log, libraries, the store's files, connections just accepted
constexpr std::size_t kAdmin = kAdminThreads + kAdminWaiting; ///< connections to the address for metrics
constexpr std::size_t kPerRequest = 5; ///< its connection, the scene, the specification, the reply, a file of the store
constexpr std::size_t kPerWorker = 8;  ///< its channel and process, and those of the one that takes its place
constexpr std::size_t kPerJobFrame = 4; ///< as a request, without a connection
constexpr std::size_t kLeastLeft = 64;
constexpr std::size_t kMostConnections = 2'048;
constexpr std::size_t kMostScenes = 65'536;
constexpr std::size_t kMostJobs = 256;

} // namespace

std::size_t raiseDescriptorLimit() {
  rlimit limit{};
  if (::getrlimit(RLIMIT_NOFILE, &limit) != 0) return 0;
  limit.rlim_cur = limit.rlim_max;
  ::setrlimit(RLIMIT_NOFILE, &limit);
  ::getrlimit(RLIMIT_NOFILE, &limit);
  return limit.rlim_cur;
}

Result<DescriptorPlan> planDescriptors(std::size_t descriptors, const DescriptorUse& use) {
  const std::size_t atWork =
      kProcess + kAdmin + use.httpThreads * kPerRequest + use.workers * kPerWorker + use.jobFrames * kPerJobFrame;
  if (const std::size_t least = atWork + kLeastLeft; descriptors < least) {
    return Problem{ProblemCode::unavailable, "",
                   "The system grants this process too few open files (ulimit -n): these --http-threads, --workers "
                   "and --job-frames take at least " +
                       std::to_string(least) + ".",
                   std::to_string(least), std::to_string(descriptors)};
  }
  const std::size_t jobs = std::min((descriptors - atWork) / 8, kMostJobs);
  const std::size_t left = descriptors - atWork - jobs;
  const std::size_t scenes = use.keepsScenesInMemory ? std::min(left / 2, kMostScenes) : 0;
  return DescriptorPlan{std::min(left - scenes, kMostConnections), scenes, jobs};
}

} // namespace gnomon
