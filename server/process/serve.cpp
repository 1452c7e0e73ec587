#include "server/process/serve.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <malloc.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/signalfd.h>
#include <thread>
#include <unistd.h>

#include "renderer/core/parallel.h"
#include "server/handlers/routes.h"
#include "server/http/http_server.h"
#include "server/http/request_log.h"
#include "server/scenes/light_map_directory.h"
#include "server/system/file_descriptor.h"

namespace gnomon {
namespace {

/// SIGTERM and SIGINT, received by waiting. Blocks both for the calling thread and those that it starts later.
class ShutdownSignals {
 public:
  ShutdownSignals();

  enum class Event { signal, done, timeout };

  /// Waits for the next signal, for `done`, or for the deadline.
  Event wait(const StopSignal& done, Clock::time_point deadline);

 private:
  FileDescriptor signals_;
};

ShutdownSignals::ShutdownSignals() {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGTERM);
  sigaddset(&set, SIGINT);
  pthread_sigmask(SIG_BLOCK, &set, nullptr);
  signals_ = FileDescriptor(::signalfd(-1, &set, SFD_CLOEXEC | SFD_NONBLOCK));
}

ShutdownSignals::Event ShutdownSignals::wait(const StopSignal& done, Clock::time_point deadline) {
  while (true) {
    std::array<pollfd, 2> waiting{{{signals_.get(), POLLIN, 0}, {done.fd(), POLLIN, 0}}};
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now()).count();
    ::poll(waiting.data(), waiting.size(), static_cast<int>(std::clamp<std::int64_t>(left, 0, 60'000)));
    if (waiting[1].revents != 0) {
      return Event::done;
    }
    signalfd_siginfo info{};
    if (waiting[0].revents != 0 && ::read(signals_.get(), &info, sizeof info) == sizeof info) {
      return Event::signal;
    }
    if (Clock::now() >= deadline) {
      return Event::timeout;
    }
  }
}

/// Prints one line for each problem.
int failed(const Problems& problems) {
  for (const Problem& problem : problems) {
    const std::string actual = problem.actual.empty() ? "" : " (" + problem.actual + ")";
    std::fprintf(stderr, "gnomon: %s%s\n", problem.detail.c_str(), actual.c_str());
  }
  return 1;
}

/// Every connection needs a descriptor: asks for as many as the system allows.
void raiseDescriptorLimit() {
  rlimit limit{};
  if (::getrlimit(RLIMIT_NOFILE, &limit) == 0) {
    limit.rlim_cur = limit.rlim_max;
    ::setrlimit(RLIMIT_NOFILE, &limit);
  }
}

/// Large blocks come from the system and go back to it at once. A heap keeps what a frame takes free at its end: pages
/// that go and come with every frame cost an eighth of a small one. Threads share heaps, one for each core and one
/// more, so that what all of them keep is bounded. By default (mallopt(3)) the allocator makes eight for each core and
/// raises the sizes as it sees larger blocks, and a server never returns memory. Its own variables have the last word.
void boundHeaps() {
  const auto unlessSet = [](const char* variable, int parameter, int value) {
    if (std::getenv(variable) == nullptr) mallopt(parameter, value);
  };
  unlessSet("MALLOC_ARENA_MAX", M_ARENA_MAX, coresToUse() + 1);
  unlessSet("MALLOC_MMAP_THRESHOLD_", M_MMAP_THRESHOLD, 4 << 20); // bytes
  unlessSet("MALLOC_TRIM_THRESHOLD_", M_TRIM_THRESHOLD, 16 << 20);
}

std::string addressOf(const std::string& bind, int port) {
  const bool ipv6 = bind.find(':') != std::string::npos;
  return "http://" + (ipv6 ? "[" + bind + "]" : bind) + ":" + std::to_string(port);
}

[[noreturn]] void endNow(const char* why) {
  logEvent("ended", why);
  ::_exit(1); // no destructors: threads may be stuck, and nothing on disk is half-written
}

/// Runs the listener until a signal arrives, then finishes the requests in progress. 0, or 1 where accepting failed.
int runUntilSignalled(const ServeOptions& options, ShutdownSignals& signals, HttpServer& server, Services& services) {
  StopSignal listenerEnded;
  bool inOrder = false;
  std::thread listening([&] {
    inOrder = server.run();
    listenerEnded.raise();
  });
  signals.wait(listenerEnded, Clock::time_point::max());
  services.draining = true;
  logEvent("draining", "The server is shutting down.");
  if (!listenerEnded.raised() && options.drainSeconds > 0 &&
      signals.wait(listenerEnded, Clock::now() + std::chrono::seconds(options.drainSeconds)) ==
          ShutdownSignals::Event::signal) {
    endNow("A second signal arrived.");
  }
  StopSignal done;
  const auto grace = Clock::now() + std::chrono::seconds(options.graceSeconds);
  std::thread finishing([&] {
    server.stop();
    services.queue.close(grace);
    listening.join();
    done.raise();
  });
  constexpr std::chrono::seconds kSlack{5}; // for a frame that began just before the grace ended
  switch (signals.wait(done, grace + kSlack)) {
    case ShutdownSignals::Event::signal:
      endNow("A second signal arrived.");
    case ShutdownSignals::Event::timeout:
      endNow("The grace period is over and work is still running.");
    case ShutdownSignals::Event::done:
      break;
  }
  finishing.join();
  logEvent("ended", inOrder ? "All work was finished." : "Connections could no longer be accepted.");
  return inOrder ? 0 : 1;
}

} // namespace

int serve(const ServeOptions& options) {
  ShutdownSignals signals;
  raiseDescriptorLimit();
  boundHeaps();
  std::signal(SIGPIPE, SIG_IGN); // a log that nobody reads any more must not end the server

  Limits limits;
  limits.maxSceneBytes = options.maxSceneBytes;
  std::shared_ptr<LightMapDirectory> lightMaps;
  if (!options.storeDirectory.empty()) {
    lightMaps =
        std::make_shared<LightMapDirectory>(options.storeDirectory + "/light-maps", options.storedLightMapBytes);
  }
  auto store = SceneStore::open({options.storeDirectory, options.sceneMemoryBytes, limits, lightMaps});
  if (!store) {
    return failed(store.problems());
  }
  auto queue = RenderQueue::start({.backend = options.backend,
                                   .gpuSceneBytes = options.gpuSceneBytes,
                                   .tracedSceneBytes = options.tracedSceneBytes,
                                   .lightMapBytes = options.lightMapBytes,
                                   .lightMaps = lightMaps,
                                   .tileCacheBytes = options.tileCacheBytes},
                                  options.queueLimit);
  if (!queue) {
    return failed(queue.problems());
  }
  const RendererInfo& info = (*queue)->info();
  logEvent("renderer", info.backend + " " + info.platform + ": " + info.renderer + ", " + info.version);

  ByteBudget frameMemory(options.frameMemoryBytes);
  Services services{.store = **store,
                    .queue = **queue,
                    .frameMemory = frameMemory,
                    .limits = limits,
                    .requestTimeout = std::chrono::seconds(options.requestTimeoutSeconds),
                    .page = options.page,
                    .evaluations = {.queue = **queue,
                                    .frameMemory = frameMemory,
                                    .timeout = std::chrono::seconds(options.evaluationTimeoutSeconds),
                                    .running = std::counting_semaphore<>(options.maxEvaluations)},
                    .choices = {},
                    .bakes = {.baker = (*queue)->baker(),
                              .frameMemory = frameMemory,
                              .timeout = std::chrono::seconds(options.evaluationTimeoutSeconds),
                              .book = {}}};
  ConnectionContext context{makeService(services), {}, ByteBudget(options.uploadMemoryBytes), {}};
  auto server = HttpServer::listen({options.bind, options.port, options.httpThreads}, context);
  if (!server) {
    return failed(server.problems());
  }
  const std::string address = addressOf(options.bind, (*server)->port());
  logEvent("listening", address);
  std::printf("listening on %s\n", address.c_str());
  std::fflush(stdout);
  return runUntilSignalled(options, signals, **server, services);
}

} // namespace gnomon
