#include "server/process/resource_plan.h"

#include <algorithm>
#include <string>
#include <sys/resource.h>

#include "server/process/admin_address.h"
#include "server/process/stores.h"

namespace gnomon {
namespace {

constexpr std::size_t kProcess = 60; ///< log, libraries, the store's files, connections just accepted
constexpr std::size_t kAdmin = kAdminThreads + kAdminWaiting; ///< connections to the address for metrics
constexpr std::size_t kPerRequest = 5; ///< its connection, the scene, the specification, the reply, a file of the store
constexpr std::size_t kPerWorker = 8;  ///< its channel and process, and those of the one that takes its place
constexpr std::size_t kPerJobFrame = 4; ///< as a request, without a connection
constexpr std::size_t kLeastLeft = 64;
constexpr std::size_t kMostConnections = 2'048;
constexpr std::size_t kMostReplies = 1'024;
constexpr std::size_t kMostScenes = 65'536;
constexpr std::size_t kMostJobs = 256;

constexpr std::uint64_t kListening = 64u << 20;        ///< program, threads and heads of the process that listens
constexpr std::uint64_t kWorkerItself = 80u << 20;     ///< program and threads of a worker
constexpr std::uint64_t kMemoryForWorker = 400u << 20; ///< below it there are fewer workers
constexpr std::uint64_t kLeastWorkers = 2;             ///< where there is memory for them

} // namespace

ServeOptions fittedTo(std::uint64_t memoryBytes) {
  ServeOptions options;
  const std::uint64_t processes =
      kListening + kWorkerItself * std::clamp<std::uint64_t>(memoryBytes / kMemoryForWorker, 1, kLeastWorkers);
  const std::uint64_t shared = memoryBytes - std::min(processes, memoryBytes / 3);
  const auto atMost = [&](std::size_t& bytes, std::uint64_t part) {
    bytes = std::min<std::size_t>(bytes, shared / part);
  };
  atMost(options.frameMemoryBytes, 3);
  atMost(options.sceneMemoryBytes, 11);
  atMost(options.uploadMemoryBytes, 12);
  atMost(options.tracedSceneBytes, 14);
  atMost(options.bundleMemoryBytes, 20);
  atMost(options.replyMemoryBytes, 18);
  atMost(options.videoMemoryBytes, 24);
  atMost(options.gpuSceneBytes, 32);
  atMost(options.replyCacheBytes, 48);
  atMost(options.tileCacheBytes, 48);
  atMost(options.lightMapBytes, 48);
  atMost(options.volumeBytes, 32);
  atMost(options.environmentBytes, 48);
  options.jobBytes = std::min(options.jobBytes, shared / 64);
  options.maxSceneBytes = std::min(options.maxSceneBytes, options.uploadMemoryBytes / 2);
  return options;
}

std::size_t usualWorkers(int cores, std::uint64_t memoryBytes) {
  constexpr int kCores = 4;
  const auto wanted = std::max(kLeastWorkers, static_cast<std::uint64_t>(cores / kCores));
  return static_cast<std::size_t>(std::clamp<std::uint64_t>(memoryBytes / kMemoryForWorker, 1, wanted));
}

std::uint64_t workerBytes(const ServeOptions& options, std::size_t workers, std::uint64_t memoryBytes) {
  const std::uint64_t bundles = keepsScenesInMemory(options) ? options.bundleMemoryBytes + options.jobBytes : 0;
  const std::uint64_t front = kListening + options.uploadMemoryBytes + options.replyMemoryBytes +
                              options.videoMemoryBytes + options.replyCacheBytes + bundles;
  constexpr std::uint64_t kLeast = 256u << 20; ///< below it a worker can't draw at all
  const std::uint64_t part = (memoryBytes - std::min(front, memoryBytes)) / workers;
  return std::max(kLeast, part / 8 * 7);
}

std::uint64_t vdbReaderBytes(std::uint64_t workerBytes) {
  constexpr std::uint64_t kMost = 2ull << 30; // the largest grid fits four times
  return std::min(workerBytes / 7, kMost);
}

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
  const std::size_t replies = std::min((descriptors - atWork) / 8, kMostReplies);
  const std::size_t left = descriptors - atWork - jobs - replies;
  const std::size_t scenes = use.keepsScenesInMemory ? std::min(left / 2, kMostScenes) : 0;
  return DescriptorPlan{std::min(left - scenes, kMostConnections), replies, scenes, jobs};
}

std::string shortageOf(const DescriptorPlan& plan, std::size_t descriptors) {
  if (plan.waitingConnections >= kMostConnections && plan.waitingReplies >= kMostReplies && plan.jobs >= kMostJobs)
    return "";
  const auto ofMost = [](std::size_t has, std::size_t most, const char* what) {
    return std::to_string(has) + " of " + std::to_string(most) + " " + what;
  };
  return "The system grants this process " + std::to_string(descriptors) + " open files (ulimit -n), room for " +
         ofMost(plan.waitingReplies, kMostReplies, "replies that wait for jobs, ") +
         ofMost(plan.waitingConnections, kMostConnections, "connections without a request and ") +
         ofMost(plan.jobs, kMostJobs, "jobs.");
}

} // namespace gnomon
