#include "server/metrics/readings.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <string_view>
#include <sys/resource.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace gnomon::metrics {
namespace {

using prometheus::ClientMetric;
using prometheus::MetricType;

/// One series of a metric.
struct Reading {
  std::vector<ClientMetric::Label> labels;
  double value = 0;
};
using Readings = std::vector<Reading>;

struct ReadingRow {
  const char* name;
  MetricType type;
  const char* help;
  Readings (*read)(const Snapshot&);
};

template <class Number>
Readings one(Number value) {
  return {{{}, static_cast<double>(value)}};
}

template <class Names, class Values>
Readings by(const char* label, const Names& names, const Values& values) {
  Readings readings;
  for (std::size_t i = 0; i < names.size(); ++i) {
    readings.push_back({{{label, std::string(names[i])}}, static_cast<double>(values[i])});
  }
  return readings;
}

/// Nothing while the queue of jobs can't be reached.
template <class Read>
Readings ofJobs(const Snapshot& snapshot, Read read) {
  return snapshot.jobs ? one(read(*snapshot.jobs)) : Readings();
}

std::string_view deviceName(const RendererInfo& renderer) {
  return renderer.device == DeviceChoice::cpu ? "cpu" : "gl";
}

constexpr MetricType kGauge = MetricType::Gauge;
constexpr MetricType kCounter = MetricType::Counter;

constexpr std::array kRows{
    ReadingRow{"gnomon_build_info", kGauge, "1, with what draws in this server.",
               [](const Snapshot& s) -> Readings {
                 return {{{{"version", s.version},
                           {"device", std::string(deviceName(s.renderer))},
                           {"renderer", s.renderer.renderer}},
                          1}};
               }},
    ReadingRow{"gnomon_draining", kGauge, "1 while the server shuts down.",
               [](const Snapshot& s) { return one(s.draining); }},
    ReadingRow{"gnomon_http_requests_in_progress", kGauge, "Requests that have a thread.",
               [](const Snapshot& s) { return one(s.requestsInProgress); }},
    ReadingRow{"gnomon_http_threads", kGauge, "Requests that may be in progress (--http-threads).",
               [](const Snapshot& s) { return one(s.threads); }},
    ReadingRow{"gnomon_queue_tasks", kGauge, "Tasks that wait for a worker, by lane.",
               [](const Snapshot& s) { return by("lane", kLaneNames, s.workers.waitingByLane); }},
    ReadingRow{"gnomon_queue_limit_tasks", kGauge, "Tasks that may wait (--queue-limit).",
               [](const Snapshot& s) { return one(s.workers.limit); }},
    ReadingRow{"gnomon_running_tasks", kGauge, "Tasks in workers' hands, by lane.",
               [](const Snapshot& s) { return by("lane", kLaneNames, s.workers.runningByLane); }},
    ReadingRow{"gnomon_workers_configured", kGauge, "Workers that are to run.",
               [](const Snapshot& s) { return one(s.workers.workers); }},
    ReadingRow{"gnomon_workers_ready", kGauge, "Of these, those that can draw.",
               [](const Snapshot& s) { return one(s.workers.ready); }},
    ReadingRow{"gnomon_workers_resident_bytes", kGauge, "Memory of all workers.",
               [](const Snapshot& s) { return one(s.workerBytes); }},
    ReadingRow{"gnomon_worker_replacements_total", kCounter, "Workers that were replaced, by reason.",
               [](const Snapshot& s) { return by("reason", kWorkerEndNames, s.workers.replacements); }},
    ReadingRow{"gnomon_reused_meshes_total", kCounter, "Meshes of loaded files that another loaded scene had already.",
               [](const Snapshot& s) { return one(s.workers.reusedMeshes); }},
    ReadingRow{"gnomon_reused_images_total", kCounter, "Images of loaded files that another loaded scene had already.",
               [](const Snapshot& s) { return one(s.workers.reusedImages); }},
    ReadingRow{"gnomon_upload_memory_bytes", kGauge, "Bodies of requests in progress.",
               [](const Snapshot& s) { return one(s.uploads.used); }},
    ReadingRow{"gnomon_upload_memory_limit_bytes", kGauge, "Of these, the most (--upload-memory-bytes).",
               [](const Snapshot& s) { return one(s.uploads.limit); }},
    ReadingRow{"gnomon_reply_memory_bytes", kGauge, "Replies that clients are taking.",
               [](const Snapshot& s) { return one(s.replies.used); }},
    ReadingRow{"gnomon_reply_memory_limit_bytes", kGauge, "Of these, the most (--reply-memory-bytes).",
               [](const Snapshot& s) { return one(s.replies.limit); }},
    ReadingRow{"gnomon_reply_cache_bytes", kGauge, "Pictures kept for equal requests.",
               [](const Snapshot& s) { return one(s.cache.bytes); }},
    ReadingRow{"gnomon_reply_cache_limit_bytes", kGauge, "Of these, the most (--reply-cache-bytes).",
               [](const Snapshot& s) { return one(s.cacheLimit); }},
    ReadingRow{"gnomon_reply_cache_hits_total", kCounter, "Requests for a picture that was kept.",
               [](const Snapshot& s) { return one(s.cache.hits); }},
    ReadingRow{"gnomon_reply_cache_misses_total", kCounter, "Requests for a picture that was not.",
               [](const Snapshot& s) { return one(s.cache.misses); }},
    ReadingRow{"gnomon_frames_shared_total", kCounter, "Replies that were drawn for another request at the same time.",
               [](const Snapshot& s) { return one(s.framesShared); }},
    ReadingRow{"gnomon_store_scenes", kGauge, "Scenes that are stored.",
               [](const Snapshot& s) { return one(s.store.scenes); }},
    ReadingRow{"gnomon_store_bytes", kGauge, "Bytes of the stored scenes.",
               [](const Snapshot& s) { return one(s.store.bytes); }},
    ReadingRow{"gnomon_store_reachable", kGauge,
               "0 while the Redis server of the store is away, or its directory can't be read.",
               [](const Snapshot& s) { return one(s.storeState.isReachable); }},
    ReadingRow{"gnomon_store_connections", kGauge, "Open connections to the Redis server of the store.",
               [](const Snapshot& s) { return one(s.storeState.connections); }},
    ReadingRow{"gnomon_store_calls_total", kCounter, "Calls of the Redis server of the store.",
               [](const Snapshot& s) { return one(s.storeState.calls); }},
    ReadingRow{"gnomon_store_call_failures_total", kCounter, "Store calls that failed or timed out.",
               [](const Snapshot& s) { return one(s.storeState.failures); }},
    ReadingRow{"gnomon_store_memory_scenes", kGauge, "Scenes of a store in Redis that are in memory, too.",
               [](const Snapshot& s) { return one(s.storeState.inMemory.scenes); }},
    ReadingRow{"gnomon_store_memory_bytes", kGauge, "Bytes of those in memory.",
               [](const Snapshot& s) { return one(s.storeState.inMemory.bytes); }},
    ReadingRow{"gnomon_store_memory_hits_total", kCounter, "Scenes of a store in Redis that were found in memory.",
               [](const Snapshot& s) { return one(s.storeState.hits); }},
    ReadingRow{"gnomon_store_memory_misses_total", kCounter, "Scenes that were read from Redis.",
               [](const Snapshot& s) { return one(s.storeState.misses); }},
    ReadingRow{"gnomon_jobs", kGauge, "Jobs that are kept, of all servers that share them.",
               [](const Snapshot& s) { return ofJobs(s, [](const JobsSize& jobs) { return jobs.jobs; }); }},
    ReadingRow{"gnomon_jobs_bytes", kGauge, "Bytes of their requests and pictures.",
               [](const Snapshot& s) { return ofJobs(s, [](const JobsSize& jobs) { return jobs.bytes; }); }},
    ReadingRow{"gnomon_job_frames_left", kGauge, "Their frames that wait or are in work.",
               [](const Snapshot& s) { return ofJobs(s, [](const JobsSize& jobs) { return jobs.framesLeft; }); }},
    ReadingRow{"gnomon_job_frames_total", kCounter, "Frames of jobs that this server took, by what became of them.",
               [](const Snapshot& s) { return by("end", kFrameEndNames, s.jobFrames); }},
    ReadingRow{"gnomon_log_lines_dropped_total", kCounter, "Log lines dropped because the reader was too slow.",
               [](const Snapshot& s) { return one(s.logLinesDropped); }},
    ReadingRow{"process_resident_memory_bytes", kGauge, "Memory of the process that listens.",
               [](const Snapshot& s) { return one(s.process.residentBytes); }},
    ReadingRow{"process_virtual_memory_bytes", kGauge, "Address space of the process that listens.",
               [](const Snapshot& s) { return one(s.process.virtualBytes); }},
    ReadingRow{"process_open_fds", kGauge, "Open descriptors.",
               [](const Snapshot& s) { return one(s.process.openFiles); }},
    ReadingRow{"process_max_fds", kGauge, "Descriptors that may be open.",
               [](const Snapshot& s) { return one(s.process.mostFiles); }},
    ReadingRow{"process_threads", kGauge, "Threads of the process that listens.",
               [](const Snapshot& s) { return one(s.process.threads); }},
    ReadingRow{"process_cpu_seconds_total", kCounter, "Time of processors that it took.",
               [](const Snapshot& s) { return one(s.process.processorSeconds); }},
    ReadingRow{"process_start_time_seconds", kGauge, "When it started, in seconds since 1970.",
               [](const Snapshot& s) { return one(s.process.startSeconds); }},
};

/// Seconds since 1970 at which the machine started: btime of /proc/stat.
double machineStart() {
  std::ifstream file("/proc/stat");
  double seconds = 0;
  for (std::string word; file >> word;) {
    if (word == "btime") {
      file >> seconds;
      break;
    }
  }
  return seconds;
}

std::uint64_t entriesOf(const char* directory) {
  std::error_code error;
  std::uint64_t count = 0;
  for (std::filesystem::directory_iterator entry(directory, error), end; !error && entry != end;
       entry.increment(error)) {
    ++count;
  }
  return count;
}

} // namespace

std::vector<prometheus::MetricFamily> readingsOf(const Snapshot& snapshot) {
  std::vector<prometheus::MetricFamily> families;
  for (const ReadingRow& row : kRows) {
    prometheus::MetricFamily family{row.name, row.help, row.type, {}};
    for (Reading& reading : row.read(snapshot)) {
      ClientMetric metric;
      metric.label = std::move(reading.labels);
      (row.type == kCounter ? metric.counter.value : metric.gauge.value) = reading.value;
      family.metric.push_back(std::move(metric));
    }
    families.push_back(std::move(family));
  }
  return families;
}

ProcessUse processUse() {
  // Fields of /proc/self/stat after the program's name in brackets, which may hold anything; the first of them is 3.
  constexpr std::size_t kUser = 14 - 3, kSystem = 15 - 3, kThreads = 20 - 3, kStart = 22 - 3, kVirtual = 23 - 3,
                        kResident = 24 - 3, kFields = 22;
  std::ifstream file("/proc/self/stat");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  std::array<double, kFields> fields{};
  if (const std::size_t name = text.rfind(')'); name != std::string::npos) {
    std::istringstream rest(text.substr(name + 1));
    std::string state;
    rest >> state;
    for (std::size_t i = 1; i < kFields && rest; ++i) rest >> fields[i];
  }
  static const double kTicks = static_cast<double>(::sysconf(_SC_CLK_TCK));
  static const double kBoot = machineStart();
  ProcessUse use;
  use.residentBytes = static_cast<std::uint64_t>(fields[kResident] * static_cast<double>(::sysconf(_SC_PAGESIZE)));
  use.virtualBytes = static_cast<std::uint64_t>(fields[kVirtual]);
  use.threads = static_cast<std::uint64_t>(fields[kThreads]);
  use.processorSeconds = (fields[kUser] + fields[kSystem]) / kTicks;
  use.startSeconds = kBoot + fields[kStart] / kTicks;
  use.openFiles = entriesOf("/proc/self/fd");
  rlimit files{};
  if (::getrlimit(RLIMIT_NOFILE, &files) == 0) use.mostFiles = files.rlim_cur;
  return use;
}

} // namespace gnomon::metrics
