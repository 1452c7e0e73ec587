#include "server/process/serve.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <fcntl.h>
#include <functional>
#include <memory>
#include <thread>
#include <unistd.h>
#include <utility>

#include "renderer/core/parallel.h"
#include "server/access/access_check.h"
#include "server/handlers/handlers.h"
#include "server/handlers/job_runners.h"
#include "server/http/http_server.h"
#include "server/http/origin_check.h"
#include "server/metrics/request_metrics.h"
#include "server/process/admin_address.h"
#include "server/process/resource_plan.h"
#include "server/process/serve_inputs.h"
#include "server/process/service_manager.h"
#include "server/process/signals.h"
#include "server/process/stores.h"
#include "server/system/file_descriptor.h"
#include "server/system/log.h"
#include "server/system/memory_limit.h"

namespace gnomon {
namespace {

constexpr std::chrono::milliseconds kLogPatience{500};

/// Prints one line for each problem.
int failed(const Problems& problems) {
  flushLog(kLogPatience);
  for (const Problem& problem : problems) {
    const std::string actual = problem.actual.empty() ? "" : " (" + problem.actual + ")";
    std::fprintf(stderr, "gnomon: %s%s\n", problem.detail.c_str(), actual.c_str());
  }
  return 1;
}

constexpr const char* kAbandoned = "Standard input was closed: the program that started the server has ended.";

[[noreturn]] void endNow(const char* why) {
  logEvent("ended", why);
  flushLog(kLogPatience);
  ::_exit(1); // no destructors: threads may be stuck, and nothing on disk is half-written
}

/// Where something more asks a process to end that is ending already.
void endIfUrged(Signals::Event event) {
  if (event == Signals::Event::signal) endNow("A second signal arrived.");
  if (event == Signals::Event::abandoned) endNow(kAbandoned);
}

// From the grace's end to that of the process: replies to what was called off are sent, then taken, then lost.
constexpr std::chrono::milliseconds kForReplies{500};
constexpr std::chrono::milliseconds kForEverything{1'250};

/// Finishes the requests in progress as long as the grace lasts. A second signal ends the process.
void finish(Signals& signals, HttpServer& server, const StopSignal& done, Clock::time_point grace) {
  const auto waitUntil = [&](Clock::time_point deadline) {
    const Signals::Event event = signals.wait(done, deadline);
    endIfUrged(event);
    return event == Signals::Event::done;
  };
  if (waitUntil(grace)) return;
  server.cutBodies();
  if (waitUntil(grace + kForReplies)) return;
  server.cutReplies();
  if (!waitUntil(grace + kForEverything)) endNow("The grace period is over and work is still running.");
}

/// Runs the listener until a signal arrives, then finishes the requests in progress; at once where no client is left
/// that waits for them. 0, or 1 where accepting failed.
int runUntilSignalled(const ServeOptions& options, Signals& signals, HttpServer& server, Services& services) {
  const int port = server.port();
  StopSignal listenerEnded;
  bool inOrder = false;
  bool abandoned = false;
  std::thread listening([&] {
    inOrder = server.run();
    listenerEnded.raise();
  });
  {
    const Watchdog watchdog(
        [bind = options.bind, port](std::chrono::milliseconds patience) { return answersLivez(bind, port, patience); });
    abandoned = signals.wait(listenerEnded, Clock::time_point::max()) == Signals::Event::abandoned;
    constexpr auto kAfterwards = std::chrono::ceil<std::chrono::seconds>(kForEverything + kLogPatience);
    tellStopping(std::chrono::seconds(abandoned ? 0 : options.drainSeconds + options.graceSeconds) + kAfterwards);
  }
  services.draining = true;
  logEvent("draining", abandoned ? kAbandoned : "The server is shutting down.");
  if (!listenerEnded.raised() && !abandoned && options.drainSeconds > 0)
    endIfUrged(signals.wait(listenerEnded, Clock::now() + std::chrono::seconds(options.drainSeconds)));
  StopSignal done;
  const auto grace = Clock::now() + std::chrono::seconds(abandoned ? 0 : options.graceSeconds);
  std::thread finishing([&] {
    server.stop();
    services.workers.endAt(grace);
    listening.join();
    done.raise();
  });
  finish(signals, server, done, grace);
  finishing.join();
  logEvent("ended", inOrder ? "All work was finished." : "Connections could no longer be accepted.");
  flushLog(kLogPatience);
  return inOrder ? 0 : 1;
}

std::size_t workersOf(const ServeOptions& options) {
  return options.workers > 0 ? options.workers : usualWorkers(coresToUse(), memoryLimit());
}

std::size_t jobFramesOf(const ServeOptions& options) {
  return options.jobFrames > 0 ? options.jobFrames : workersOf(options);
}

/// What all workers may keep together is shared out.
DispatcherOptions dispatcherOptions(const ServeOptions& options, std::shared_ptr<StoredLightMaps> lightMaps,
                                    metrics::RequestMetrics& counted) {
  const std::uint64_t memory = memoryLimit();
  const std::size_t workers = workersOf(options);
  const std::uint64_t each = workerBytes(options, workers, memory);
  return {.program = options.workerProgram,
          .workers = workers,
          .queueLimit = options.queueLimit,
          .each = {.device = options.device,
                   .backend = options.backend,
                   .requireGpu = options.requireGpu,
                   .gpuSceneBytes = options.gpuSceneBytes / workers,
                   .tileCacheBytes = options.tileCacheBytes / workers,
                   .tracedSceneBytes = options.tracedSceneBytes / workers,
                   .lightMapBytes = options.lightMapBytes / workers,
                   .volumeBytes = options.volumeBytes / workers,
                   .environmentBytes = options.environmentBytes / workers,
                   .sceneMemoryBytes = options.sceneMemoryBytes / workers,
                   .frameMemoryBytes = options.frameMemoryBytes / workers,
                   .maxSceneBytes = options.maxSceneBytes,
                   .memoryBytes = each,
                   .vdbBytes = vdbReaderBytes(each),
                   .keepsLightMaps = lightMaps != nullptr},
          .lightMaps = lightMaps,
          .waited = [&counted](Lane lane, double seconds) { counted.waited(lane, seconds); }};
}

/// A store in Redis learns of uses, and removes what is too old, within a second.
KeepingPeriod keepingOf(const ServeOptions& options) {
  KeepingPeriod period{.age = std::chrono::seconds(options.storeAgeSeconds)};
  if (redis::isAddress(options.store)) period.longest = std::chrono::seconds(1);
  return period;
}

} // namespace

int serve(const ServeOptions& options, ServeInputs inputs, std::vector<StaticFile> page) {
  const std::function<void()> reload = [&keys = inputs.keys] {
    tellReloading();
    if (keys) keys->reload();
    if (!keys) logEvent("keys", "SIGHUP arrived; there are no keys (--keys) to be read again.");
    tellReady(keys ? "The keys were read again." : "There are no keys to be read again.");
  };
  FileDescriptor starter(options.untilStdinCloses ? ::fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, STDERR_FILENO + 1) : -1);
  if (options.untilStdinCloses && !starter) {
    return failed({{ProblemCode::invalidValue, "until-stdin-closes",
                    "--until-stdin-closes needs a standard input, and it is closed already.", "", ""}});
  }
  Signals signals(reload, std::move(starter));
  if (inputs.keys) inputs.keys->warnOfReaders();
  const std::size_t granted = raiseDescriptorLimit();
  const auto descriptors = planDescriptors(granted, {.httpThreads = options.httpThreads,
                                                     .workers = workersOf(options),
                                                     .jobFrames = jobFramesOf(options),
                                                     .keepsScenesInMemory = keepsScenesInMemory(options)});
  if (!descriptors) return failed(descriptors.problems());
  if (const std::string shortage = shortageOf(*descriptors, granted); !shortage.empty()) logEvent("files", shortage);
  boundHeaps(coresToUse() + 1);
  std::signal(SIGPIPE, SIG_IGN); // a log without a reader must not end the server

  Limits limits;
  limits.maxSceneBytes = options.maxSceneBytes;
  const auto store = openStore(options, inputs.store, descriptors->scenesInMemory);
  if (!store) return failed(store.problems());
  metrics::RequestMetrics counted;
  auto workers = Dispatcher::start(dispatcherOptions(options, store->lightMaps, counted));
  if (!workers) return failed(workers.problems());
  ByteBudget replyBytes(options.replyMemoryBytes);
  const JobLimits jobLimits{.jobs = descriptors->jobs,
                            .jobsOfClient = options.jobsPerClient,
                            .bytes = options.jobBytes,
                            .age = std::chrono::seconds(options.jobAgeSeconds)};
  const auto jobs = openJobs(options, jobLimits, inputs.jobs, store->redis);
  Services services{.store = *store->scenes,
                    .workers = **workers,
                    .replyBytes = replyBytes,
                    .jobs = *jobs,
                    .jobLimits = jobLimits,
                    .waits = FairShares(descriptors->waitingReplies),
                    .limits = limits,
                    .requestTimeout = std::chrono::seconds(options.requestTimeoutSeconds),
                    .evaluationTimeout = std::chrono::seconds(options.evaluationTimeoutSeconds),
                    .sequenceTimeout = std::chrono::seconds(options.sequenceTimeoutSeconds),
                    .page = std::move(page),
                    .evaluations = std::counting_semaphore<>(options.maxEvaluations),
                    .sequences = std::counting_semaphore<>(options.maxSequences),
                    .videoMemory = ByteBudget(options.videoMemoryBytes),
                    .replies = ReplyCache(options.replyCacheBytes),
                    .drakeColors = std::move(inputs.drakeColors)};
  std::optional<StoreKeeping> keeping;
  if (!options.store.empty()) keeping.emplace(*store->scenes, **workers, keepingOf(options));
  ConnectionLimits connections;
  connections.idle = std::chrono::seconds(options.idleTimeoutSeconds);
  connections.maxWaiting = descriptors->waitingConnections;
  HttpService service = makeService(makeRoutes(services, options.adminPort ? Addresses::two : Addresses::one));
  if (inputs.keys) service = withAccessCheck(std::move(service), inputs.keys);
  ConnectionContext context{
      withOriginCheck(std::move(service), {options.allowedHosts, options.allowedOrigins, options.bind}),
      connections,
      ByteBudget(options.uploadMemoryBytes),
      replyBytes,
      {},
      {},
      {},
      std::move(inputs.trustedProxies),
      &counted};
  services.cut = &context.cutBodies;
  services.metrics = [&] { return metrics::metricsText(counted, snapshotOf(options, services, context)); };
  services.lackingThreads = &context.lackingThreads;
  auto server =
      HttpServer::listen({options.bind, options.port, options.httpThreads, options.maxConnectionsPerAddress}, context);
  if (!server) return failed(server.problems());
  std::unique_ptr<AdminAddress> admin;
  if (options.adminPort) {
    auto opened = AdminAddress::open({options.adminBind, *options.adminPort, options.allowedHosts}, services, counted);
    if (!opened) return failed(opened.problems());
    admin = *std::move(opened);
  }
  const JobRunners takers(services, jobFramesOf(options));
  const std::string address = addressOf(options.bind, (*server)->port());
  logEvent("listening", address);
  std::printf("listening on %s\n", address.c_str());
  std::fflush(stdout);
  tellReady("listening on " + address);
  return runUntilSignalled(options, signals, **server, services);
}

} // namespace gnomon
