#include "server/process/memory_plan.h"

#include <algorithm>

#include "server/process/store_opening.h"

namespace gnomon {

ServeOptions fittedTo(std::uint64_t memoryBytes) {
  ServeOptions options;
  const auto atMost = [&](std::size_t& bytes, std::uint64_t part) {
    bytes = std::min<std::size_t>(bytes, memoryBytes / part);
  };
  atMost(options.sceneMemoryBytes, 6);
  atMost(options.frameMemoryBytes, 7);
  atMost(options.tracedSceneBytes, 9);
  atMost(options.uploadMemoryBytes, 12);
  atMost(options.gpuSceneBytes, 20);
  atMost(options.bundleMemoryBytes, 16);
  atMost(options.replyMemoryBytes, 16);
  atMost(options.videoMemoryBytes, 16);
  atMost(options.replyCacheBytes, 32);
  atMost(options.tileCacheBytes, 32);
  atMost(options.lightMapBytes, 32);
  atMost(options.volumeBytes, 72);
  options.jobBytes = std::min(options.jobBytes, memoryBytes / 40);
  options.maxSceneBytes = std::min(options.maxSceneBytes, options.uploadMemoryBytes / 2);
  return options;
}

std::size_t usualWorkers(int cores, std::uint64_t memoryBytes) {
  constexpr int kCores = 4;
  constexpr std::uint64_t kBytes = 400u << 20;
  const auto wanted = static_cast<std::uint64_t>(std::max(2, cores / kCores));
  return static_cast<std::size_t>(std::clamp<std::uint64_t>(memoryBytes / kBytes, 1, wanted));
}

std::uint64_t workerBytes(const ServeOptions& options, std::size_t workers, std::uint64_t memoryBytes) {
  constexpr std::uint64_t kListening = 64u << 20; ///< program, threads and heads of the process that listens
  const std::uint64_t bundles = keepsScenesInMemory(options) ? options.bundleMemoryBytes + options.jobBytes : 0;
  const std::uint64_t front = kListening + options.uploadMemoryBytes + options.replyMemoryBytes +
                              options.videoMemoryBytes + options.replyCacheBytes + bundles;
  constexpr std::uint64_t kLeast = 256u << 20; ///< below it a worker can't draw at all
  return std::max(kLeast, (memoryBytes - std::min(front, memoryBytes)) / workers);
}

} // namespace gnomon
