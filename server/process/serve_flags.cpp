#include "server/process/serve_flags.h"

#include <CLI/CLI.hpp>
#include <map>
#include <string>

#include "protocol/fields/fields.h"

namespace gnomon {
namespace {

constexpr int kDay = 86'400; // seconds
const std::map<std::string, std::int64_t> kTimeUnits{{"s", 1}, {"m", 60}, {"h", 3'600}, {"d", kDay}};

// Every option but `page` needs a flag below; `backend` has three.
static_assert(memberCount<ServeOptions>() == 48);

void addWhere(CLI::App& serve, ServeOptions& options) {
  serve.add_option("--bind", options.bind, "Address to listen on; 0.0.0.0 = every IPv4 address, :: = every address")
      ->envname("GNOMON_BIND")
      ->type_name("ADDRESS")
      ->group("Address and storage");
  // Not GNOMON_PORT: Kubernetes sets that one to an address when a service is called gnomon.
  serve.add_option("--port", options.port, "Port to listen on; 0 = any free one, which is printed")
      ->envname("GNOMON_LISTEN_PORT")
      ->check(CLI::Range(0, 65535))
      ->group("Address and storage");
  auto* adminPort = serve
                        .add_option("--admin-port", options.adminPort,
                                    "Port of a second address, which alone serves /metrics, and probes; 0 = any free "
                                    "one, which the log tells. Without it /metrics is served with all else")
                        ->envname("GNOMON_ADMIN_LISTEN_PORT")
                        ->check(CLI::Range(0, 65535))
                        ->type_name("INT")
                        ->default_str("")
                        ->group("Address and storage");
  serve.add_option("--admin-bind", options.adminBind, "Address of --admin-port, which asks nobody for a key")
      ->envname("GNOMON_ADMIN_BIND")
      ->type_name("ADDRESS")
      ->needs(adminPort)
      ->group("Address and storage");
  const auto addNames = [&serve](const char* flag, const char* variable, std::vector<std::string>& names,
                                 const char* what, const char* says) {
    serve.add_option(flag, names, says)
        ->envname(variable)
        ->type_name(what)
        ->delimiter(',')
        ->default_str("")
        ->group("Address and storage");
  };
  addNames("--allowed-hosts", "GNOMON_ALLOWED_HOSTS", options.allowedHosts, "NAMES",
           "Names by which clients may reach the server, beside its addresses and localhost; comma-separated, * = any, "
           "which is the default with --bind 0.0.0.0 or ::");
  addNames("--allowed-origins", "GNOMON_ALLOWED_ORIGINS", options.allowedOrigins, "ORIGINS",
           "Pages of other servers that may use this one, as https://page.example; comma-separated, * = any");
  addNames("--trusted-proxies", "GNOMON_TRUSTED_PROXIES", options.trustedProxies, "NETWORKS",
           "Addresses and networks of proxies, as 10.0.0.0/8, that name their clients in X-Forwarded-For or Forwarded; "
           "comma-separated");
  serve
      .add_option("--keys", options.keysFile,
                  "File of the keys that clients need, one a line; without it anyone may do anything. SIGHUP reads it "
                  "again")
      ->envname("GNOMON_KEYS")
      ->type_name("FILE")
      ->group("Address and storage");
  serve
      .add_option("--drake-spec", options.drakeSpecFile,
                  "File with a frame specification, JSON without size, camera, views and output, by which POST /render "
                  "draws color pictures for Drake; without it a sun from above")
      ->envname("GNOMON_DRAKE_SPEC")
      ->type_name("FILE")
      ->group("Address and storage");
  serve
      .add_option("--store", options.store,
                  "Directory that keeps scenes over a restart, or address of a Redis server that does, as "
                  "redis://HOST:6379/0, or rediss:// for TLS; without it they are kept in memory")
      ->envname("GNOMON_STORE")
      ->type_name("DIR|ADDRESS")
      ->group("Address and storage");
  serve
      .add_option("--store-bytes", options.storeBytes,
                  "Scenes kept in that store; 507 beyond it. 0 = as many as its disk or Redis takes")
      ->envname("GNOMON_STORE_BYTES")
      ->transform(CLI::AsSizeValue(false).description(""))
      ->type_name("BYTES")
      ->group("Address and storage");
  serve
      .add_option("--store-age", options.storeAgeSeconds,
                  "Scenes in that store that nobody has uploaded or drawn for so long are removed: seconds, or as "
                  "12h, 30d. 0 = never")
      ->envname("GNOMON_STORE_AGE")
      ->transform(CLI::AsNumberWithUnit(kTimeUnits).description(""))
      ->check(CLI::Range(std::int64_t{0}, std::int64_t{3'650} * kDay).description(""))
      ->type_name("SECONDS")
      ->group("Address and storage");
  serve
      .add_option("--redis-password-file", options.redisPasswordFile,
                  "File whose first line is the password of that Redis server, rather than its address")
      ->envname("GNOMON_REDIS_PASSWORD_FILE")
      ->type_name("FILE")
      ->group("Address and storage");
  serve
      .add_option("--redis-authorities", options.redisAuthorities,
                  "PEM file of the authorities that may sign that Redis server's certificate; without it those that "
                  "the system trusts")
      ->envname("GNOMON_REDIS_AUTHORITIES")
      ->type_name("FILE")
      ->group("Address and storage");
}

void addWhatDraws(CLI::App& serve, ServeOptions& options) {
  serve
      .add_option("--workers", options.workers,
                  "Processes that load scenes and draw, and share the memory for both; more draw more frames at once. "
                  "0 = a quarter of the cores, at least two, or one where memory is short")
      ->envname("GNOMON_WORKERS")
      ->check(CLI::Range(0, 256))
      ->group("Renderer");
  serve
      .add_option("--worker-program", options.workerProgram,
                  "Started as `PROGRAM worker` for each worker, e.g. a script that chooses a GPU and then executes "
                  "gnomon with the same arguments")
      ->envname("GNOMON_WORKER_PROGRAM")
      ->type_name("FILE")
      ->group("Renderer");
  serve
      .add_option_function<std::string>(
          "--device",
          [&options](const std::string& name) {
            options.backend.device = name == "cpu"  ? DeviceChoice::cpu
                                     : name == "gl" ? DeviceChoice::gl
                                                    : DeviceChoice::auto_;
          },
          "What draws; auto = OpenGL on a GPU, or else the processor, and requests may name another. cpu opens no "
          "display and loads no driver")
      ->envname("GNOMON_DEVICE")
      ->check(CLI::IsMember({"auto", "cpu", "gl"}))
      ->type_name("")
      ->default_str("auto")
      ->group("Renderer");
  serve
      .add_option_function<std::string>(
          "--backend",
          [&options](const std::string& name) {
            options.backend.backend = name == "egl"      ? Backend::egl
                                      : name == "osmesa" ? Backend::osmesa
                                                         : Backend::automatic;
          },
          "Graphics context; auto = EGL, or else OSMesa")
      ->envname("GNOMON_BACKEND")
      ->check(CLI::IsMember({"auto", "egl", "osmesa"}))
      ->type_name("")
      ->default_str("auto")
      ->group("Renderer");
  serve.add_flag("--require-gpu", options.backend.requireGpu, "Refuse to start without a GPU")
      ->envname("GNOMON_REQUIRE_GPU")
      ->group("Renderer");
}

/// Bytes, with a unit if that is handier: 512MB, 2GB (powers of 1024).
void addBytes(CLI::App& serve, const char* flag, const char* variable, std::size_t& bytes, const char* says) {
  serve.add_option(flag, bytes, says)
      ->envname(variable)
      ->transform(CLI::AsSizeValue(false).description(""))
      ->type_name("BYTES")
      ->group("Limits");
}

void addHowMuch(CLI::App& serve, ServeOptions& options) {
  addBytes(serve, "--gpu-scene-bytes", "GNOMON_GPU_SCENE_BYTES", options.gpuSceneBytes,
           "Scenes kept on the graphics device; with a unit if wanted, as 512MB or 2GB");
  addBytes(serve, "--tile-cache-bytes", "GNOMON_TILE_CACHE_BYTES", options.tileCacheBytes,
           "Shadow atlases kept for later frames; 0 = every tile is drawn for each frame");
  addBytes(serve, "--traced-scene-bytes", "GNOMON_TRACED_SCENE_BYTES", options.tracedSceneBytes,
           "Ray-tracing structures of scenes, the least recently used dropped first");
  addBytes(serve, "--light-map-bytes", "GNOMON_LIGHT_MAP_BYTES", options.lightMapBytes,
           "Baked light maps kept in memory, the least recently used dropped first");
  addBytes(
      serve, "--stored-light-map-bytes", "GNOMON_STORED_LIGHT_MAP_BYTES", options.storedLightMapBytes,
      "Baked light maps kept in the store, and settings chosen for a target, the least recently used dropped first");
  addBytes(serve, "--scene-memory-bytes", "GNOMON_SCENE_MEMORY_BYTES", options.sceneMemoryBytes,
           "Loaded scenes of all workers, the least recently used dropped first");
  addBytes(serve, "--bundle-memory-bytes", "GNOMON_BUNDLE_MEMORY_BYTES", options.bundleMemoryBytes,
           "Uploaded scenes kept without --store, the least recently used dropped first");
  addBytes(serve, "--max-scene-bytes", "GNOMON_MAX_SCENE_BYTES", options.maxSceneBytes,
           "The largest scene that may be uploaded");
  addBytes(serve, "--upload-memory-bytes", "GNOMON_UPLOAD_MEMORY_BYTES", options.uploadMemoryBytes,
           "Bodies of all requests in progress together; 429 beyond it");
  addBytes(serve, "--frame-memory-bytes", "GNOMON_FRAME_MEMORY_BYTES", options.frameMemoryBytes,
           "Pictures of all frames in progress together, and a worker's share of it for one frame (413)");
  addBytes(serve, "--reply-memory-bytes", "GNOMON_REPLY_MEMORY_BYTES", options.replyMemoryBytes,
           "Replies that clients are taking, together; 503 beyond it");
  addBytes(serve, "--video-memory-bytes", "GNOMON_VIDEO_MEMORY_BYTES", options.videoMemoryBytes,
           "Encoders of videos that are being sent, together; 429 beyond it, 413 for one that is larger");
  addBytes(serve, "--reply-cache-bytes", "GNOMON_REPLY_CACHE_BYTES", options.replyCacheBytes,
           "Pictures kept for requests that are equal, the least recently used dropped first; 0 = every one is drawn");
  serve.add_option("--queue-limit", options.queueLimit, "Requests that may wait for a worker; 429 beyond it")
      ->envname("GNOMON_QUEUE_LIMIT")
      ->check(CLI::Range(std::size_t{1}, std::size_t{100'000}))
      ->group("Limits");
  serve.add_option("--http-threads", options.httpThreads, "Requests served at once; beyond it 503, except for probes")
      ->envname("GNOMON_HTTP_THREADS")
      ->check(CLI::Range(std::size_t{1}, std::size_t{4'096}))
      ->group("Limits");
  serve
      .add_option("--max-connections-per-address", options.maxConnectionsPerAddress,
                  "Of these, requests of one client's address; beyond it 429. 0 = three quarters of --http-threads")
      ->envname("GNOMON_MAX_CONNECTIONS_PER_ADDRESS")
      ->check(CLI::Range(std::size_t{0}, std::size_t{4'096}))
      ->group("Limits");
  serve
      .add_option("--max-evaluations", options.maxEvaluations,
                  "Evaluations that may run at once, 429 beyond it; measured times are most accurate with 1")
      ->envname("GNOMON_MAX_EVALUATIONS")
      ->check(CLI::Range(1, 64))
      ->group("Limits");
  serve.add_option("--max-sequences", options.maxSequences, "Sequences that may run at once, 429 beyond it")
      ->envname("GNOMON_MAX_SEQUENCES")
      ->check(CLI::Range(1, 64))
      ->group("Limits");
}

void addJobs(CLI::App& serve, ServeOptions& options) {
  serve
      .add_option(
          "--jobs", options.jobsAddress,
          "Redis that keeps jobs, as redis://HOST:PORT/DATABASE, for all servers that name it and share a store; "
          "without it they are in the Redis of --store, or else end with the server")
      ->envname("GNOMON_JOBS")
      ->type_name("ADDRESS")
      ->group("Jobs");
  serve
      .add_option("--job-frames", options.jobFrames,
                  "Frames of jobs that are drawn at once; 0 = as many as there are workers")
      ->envname("GNOMON_JOB_FRAMES")
      ->check(CLI::Range(std::size_t{0}, std::size_t{512}))
      ->group("Jobs");
  serve
      .add_option("--max-jobs", options.jobsPerClient,
                  "Jobs that are kept for one client, whatever their state; 429 beyond it")
      ->envname("GNOMON_MAX_JOBS")
      ->check(CLI::Range(std::size_t{1}, std::size_t{256}))
      ->group("Jobs");
  serve
      .add_option("--job-bytes", options.jobBytes,
                  "Requests and pictures of all jobs, kept in Redis, the directory of --store or memory; 507 beyond it")
      ->envname("GNOMON_JOB_BYTES")
      ->transform(CLI::AsSizeValue(false).description(""))
      ->type_name("BYTES")
      ->group("Jobs");
  serve
      .add_option("--job-age", options.jobAgeSeconds,
                  "A job is removed with its pictures so long after its last frame: seconds, or as 12h, 7d")
      ->envname("GNOMON_JOB_AGE")
      ->transform(CLI::AsNumberWithUnit(kTimeUnits).description(""))
      ->check(CLI::Range(std::int64_t{1}, std::int64_t{3'650} * kDay).description(""))
      ->type_name("SECONDS")
      ->group("Jobs");
}

void addHowLong(CLI::App& serve, ServeOptions& options) {
  const auto add = [&](const char* flag, const char* variable, int& seconds, int least, const char* says) {
    serve.add_option(flag, seconds, says)
        ->envname(variable)
        ->check(CLI::Range(least, kDay))
        ->type_name("SECONDS")
        ->group("Timeouts");
  };
  add("--request-timeout", "GNOMON_REQUEST_TIMEOUT", options.requestTimeoutSeconds, 1,
      "Time for a frame from the arrival of its request; 504 beyond it");
  add("--evaluation-timeout", "GNOMON_EVALUATION_TIMEOUT", options.evaluationTimeoutSeconds, 1,
      "Time for an evaluation from the arrival of its request; 504 beyond it");
  add("--sequence-timeout", "GNOMON_SEQUENCE_TIMEOUT", options.sequenceTimeoutSeconds, 1,
      "Time for all frames of a sequence from the arrival of its request; each has --request-timeout besides");
  add("--idle-timeout", "GNOMON_IDLE_TIMEOUT", options.idleTimeoutSeconds, 1,
      "Time for which a connection without a request is kept; more than that of a proxy in front");
  add("--drain", "GNOMON_DRAIN", options.drainSeconds, 0,
      "Time after SIGTERM in which requests are served while /readyz fails, so that load balancers notice");
  add("--grace", "GNOMON_GRACE", options.graceSeconds, 0,
      "Time after that for the requests in progress; the rest get 503");
  serve
      .add_flag(
          "--until-stdin-closes", options.untilStdinCloses,
          "End within two seconds once standard input is closed, as it is when the program that holds the other end "
          "of the pipe ends, however it ends")
      ->envname("GNOMON_UNTIL_STDIN_CLOSES")
      ->group("Timeouts");
}

/// Of an option the value that it was given, wherever; empty where it has none.
std::string givenTo(const CLI::App& command, const char* flag) {
  const CLI::Option& option = *command.get_option(flag);
  return option.count() > 0 ? option.reduced_results().back() : std::string();
}

} // namespace

std::string deviceConflict(const CLI::App& command) {
  if (givenTo(command, "--device") != "cpu") return {};
  const CLI::Option& requireGpu = *command.get_option("--require-gpu");
  if (requireGpu.count() > 0 && requireGpu.as<bool>())
    return "--require-gpu asks for a GPU, and --device cpu uses none: leave one of the two out.";
  const std::string backend = givenTo(command, "--backend");
  if (backend.empty() || backend == "auto") return {};
  return "--backend chooses OpenGL's context, and --device cpu uses none: leave one of the two out.";
}

void addServeFlags(CLI::App& command, ServeOptions& options) {
  command.option_defaults()->always_capture_default();
  addWhere(command, options);
  addWhatDraws(command, options);
  addHowMuch(command, options);
  addJobs(command, options);
  addHowLong(command, options);
  command.parse_complete_callback([&command] {
    if (const std::string conflict = deviceConflict(command); !conflict.empty()) throw CLI::ValidationError(conflict);
  });
}

void addConfigFlags(CLI::App& command, ConfigChoice& choice) {
  command
      .add_option("--config", choice.file,
                  "File with further options, one KEY = VALUE a line; keys are these flags without their dashes. Flags "
                  "come before variables, variables before the file")
      ->envname("GNOMON_CONFIG")
      ->type_name("FILE")
      ->configurable(false)
      ->group("Configuration");
  command
      .add_flag("--print-config", choice.print,
                "Print all options, wherever their values are from, as such a file, and exit")
      ->configurable(false)
      ->group("Configuration");
}

} // namespace gnomon
