#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <string_view>
#include <variant>
#include <vector>

#include "server/process/option_text.h"
#include "server/process/serve.h"

/// One row for each member of ServeOptions: its flag, environment variable, key in a configuration file, and line in
/// OPERATIONS.md. A new member without its row does not compile. A default is not repeated here: it is the member's
/// initialiser.
namespace gnomon {

template <class... Types>
using MemberOfServeOptions = std::variant<Types ServeOptions::*...>;
using OptionMember = MemberOfServeOptions<bool, int, std::size_t, std::int64_t, std::string, std::optional<int>,
                                          std::vector<std::string>, DeviceChoice, Backend>;

inline constexpr double kMostBytes = 1ull << 50;
inline constexpr OptionValue kCache{kBytes, {0, kMostBytes}};    ///< 0 = nothing is kept, unless the row says otherwise
inline constexpr OptionValue kRoom{kBytes, {1'024, kMostBytes}}; ///< without any, requests could only be refused
inline constexpr OptionValue kTimeout{kSeconds, {1, 86'400}};
inline constexpr OptionValue kPause{kSeconds, {0, 86'400}};
inline constexpr double kLongestAge = 3'650.0 * 86'400; ///< seconds
inline constexpr OptionValue kFile{"FILE"};
inline constexpr OptionValue kListen{"ADDRESS", {}, listenAddressFault};
inline constexpr OptionValue kPort{"INT", {0, 65'535}};

struct OptionRow {
  std::string_view name; ///< "store-bytes": the flag --store-bytes, the variable GNOMON_STORE_BYTES
  OptionMember member;
  OptionValue value;
  std::string_view says; ///< Markdown; --help has its text
};

constexpr OptionRow option(std::string_view name, OptionMember member, OptionValue value, std::string_view says) {
  return {name, member, value, says};
}

inline constexpr std::array kStorageRows{
    option("bind", &ServeOptions::bind, kListen,
           "Address to listen on; `0.0.0.0` = every IPv4 address, `::` = every address"),
    option("port", &ServeOptions::port, kPort, "Port to listen on; 0 = any free one, which is printed"),
    option("admin-port", &ServeOptions::adminPort, kPort,
           "Port of a second address, which alone serves [metrics](#metrics), and probes; 0 = any free one, named "
           "in the log (`\"event\": \"admin\"`). Without it `/metrics` is served with all else"),
    option("admin-bind", &ServeOptions::adminBind, kListen, "Address of `--admin-port`, which needs no API key"),
    option("allowed-hosts", &ServeOptions::allowedHosts, {"NAMES", {}, allowedHostFault},
           "Names by which clients may [reach the server](#security), beside its addresses and `localhost`; "
           "comma-separated, `*` = any, which is the default with `--bind 0.0.0.0` or `::`. 421 for others"),
    option("allowed-origins", &ServeOptions::allowedOrigins, {"ORIGINS", {}, allowedOriginFault},
           "Pages of other servers that may use this one, as `https://page.example`; comma-separated, `*` = any"),
    option("trusted-proxies", &ServeOptions::trustedProxies, {"NETWORKS"},
           "Addresses and networks of [proxies](#proxies), as `10.0.0.0/8`, whose `X-Forwarded-For` or `Forwarded` is "
           "trusted; comma-separated"),
    option("keys", &ServeOptions::keysFile, kFile,
           "File of the [API keys](#keys) of clients, one a line, read again on SIGHUP; without it anyone may do "
           "anything"),
    option("drake-spec", &ServeOptions::drakeSpecFile, kFile,
           "File with a frame specification, JSON without size, `camera`, `views` and `output`, by which `POST "
           "/render` draws color pictures for [Drake](API.md#drake); without it a sun from above"),
    option("store", &ServeOptions::store, {"DIR|ADDRESS"},
           "Directory that [keeps scenes](#store) and their light maps over a restart, or address of a Redis server "
           "that does, as `redis://HOST:6379/0`, or `rediss://` for TLS; without it they are kept in memory"),
    option("store-bytes", &ServeOptions::storeBytes, kCache,
           "Scenes kept in that store, as 20GB; 507 beyond it. 0 = as many as its disk or Redis takes"),
    option("store-age", &ServeOptions::storeAgeSeconds, {kSeconds, {0, kLongestAge}},
           "Scenes in that store that were not uploaded or drawn for so long, as 30d or 12h, are removed. 0 = never"),
    option("redis-password-file", &ServeOptions::redisPasswordFile, kFile,
           "File whose first line is the password of that Redis server, and of that of `--jobs`"),
    option("redis-authorities", &ServeOptions::redisAuthorities, kFile,
           "PEM file of the authorities that may sign that Redis server's certificate; without it those that the "
           "system trusts"),
};

inline constexpr std::array kRendererRows{
    option("workers", &ServeOptions::workers, {.range = {0, 256}},
           "Processes that load scenes and draw, each with 80 MB of its own and a share of the memory for both; more "
           "draw more frames at once. 0 = a quarter of the cores, at least two, or one where memory is short"),
    option("worker-program", &ServeOptions::workerProgram, kFile,
           "Started as `PROGRAM worker` for each worker, e.g. a script that chooses a GPU or sets limits and then "
           "executes gnomon with the same arguments"),
    option("device", &ServeOptions::device, {},
           "What draws; `auto` = `gl` on a GPU, where requests may still name `cpu`, or else `cpu`, which opens no "
           "display "
           "and loads no driver. `gl` without a GPU is Mesa's software"),
    option("backend", &ServeOptions::backend, {},
           "OpenGL's context; `auto` = EGL, or else OSMesa. Another means `--device gl`, and is refused beside "
           "`--device cpu`"),
    option("require-gpu", &ServeOptions::requireGpu, {},
           "Refuse to start without a GPU; means `--device gl`, and is refused beside `--device cpu`"),
};

inline constexpr std::array kLimitRows{
    option("gpu-scene-bytes", &ServeOptions::gpuSceneBytes, kCache,
           "Scenes kept on the graphics device, as 512MB or 2GB; one that was dropped is uploaded again"),
    option("tile-cache-bytes", &ServeOptions::tileCacheBytes, kCache,
           "Shadow atlases kept for later frames, and half as much for samples of pictures; 0 = every tile is drawn "
           "for each "
           "frame"),
    option("traced-scene-bytes", &ServeOptions::tracedSceneBytes, kCache,
           "Ray-tracing structures of scenes, the least recently used dropped first"),
    option("light-map-bytes", &ServeOptions::lightMapBytes, kCache,
           "Baked light maps kept in memory, the least recently used dropped first"),
    option("stored-light-map-bytes", &ServeOptions::storedLightMapBytes, kCache,
           "Baked light maps and settings chosen for a target in the store, the least recently used dropped first"),
    option("volume-bytes", &ServeOptions::volumeBytes, kCache,
           "Grids of volumes and the light in them, the least recently used dropped first"),
    option("environment-bytes", &ServeOptions::environmentBytes, kCache,
           "Environments prepared for shading, the least recently used dropped first"),
    option("scene-memory-bytes", &ServeOptions::sceneMemoryBytes, kRoom,
           "Loaded scenes of all workers, the least recently used dropped first; one may take a worker's share"),
    option("bundle-memory-bytes", &ServeOptions::bundleMemoryBytes, kRoom,
           "Uploaded scenes kept without `--store`, or beside one in Redis, the least recently used dropped first"),
    option("max-scene-bytes", &ServeOptions::maxSceneBytes, kRoom, "The largest scene that may be uploaded; 413 above"),
    option("upload-memory-bytes", &ServeOptions::uploadMemoryBytes, kRoom,
           "Bodies of all requests in progress together; 429 beyond it, 413 for a larger one"),
    option("frame-memory-bytes", &ServeOptions::frameMemoryBytes, kRoom,
           "What drawing and encoding take of all frames in progress together: samples, layers, tiles, volumes, "
           "pictures, files; a frame waits for room, 413 above a worker's share"),
    option("reply-memory-bytes", &ServeOptions::replyMemoryBytes, kRoom,
           "Replies that clients are taking, together; 503 for one that finds no room for 5 s, but later frames of a "
           "sequence wait"),
    option("video-memory-bytes", &ServeOptions::videoMemoryBytes, kRoom,
           "Encoders of videos being sent, each 32 MB and about 80 bytes a pixel; 429 beyond it, 413 for a larger one"),
    option("reply-cache-bytes", &ServeOptions::replyCacheBytes, kCache,
           "Pictures kept for equal requests without report, the least recently used dropped first; 0 = all are drawn"),
    option(
        "queue-limit", &ServeOptions::queueLimit, {.range = {1, 100'000}},
        "Requests that may wait for a worker, of one client its [share](#load); 429 beyond it, for the newest of the "
        "client with most of them"),
    option("http-threads", &ServeOptions::httpThreads, {.range = {1, 4'096}},
           "Requests served at once, one thread each; beyond it 503, except for probes. What only waits takes none"),
    option("max-connections-per-address", &ServeOptions::maxConnectionsPerAddress, {.range = {0, 4'096}},
           "Of these, requests of one client's address (of IPv6 its first 64 bits); beyond it 429. 0 = its "
           "[share](#load). Set it behind a proxy that is not [trusted](#proxies): all clients have its address"),
    option("max-evaluations", &ServeOptions::maxEvaluations, {.range = {1, 64}},
           "Evaluations that may run at once, 429 beyond it; measured times are most accurate with 1"),
    option("max-sequences", &ServeOptions::maxSequences, {.range = {1, 64}},
           "Sequences that may run at once, 429 beyond it; each has at most two frames in work or on their way"),
};

inline constexpr std::array kJobRows{
    option("jobs", &ServeOptions::jobsAddress, {"ADDRESS"},
           "Redis that keeps [jobs](#jobs), as `redis://HOST:PORT/DATABASE`, for all servers that name it and share a "
           "store; without it they are in the Redis of `--store`, or else end with the server"),
    option("job-frames", &ServeOptions::jobFrames, {.range = {0, 512}},
           "Frames of jobs that are drawn at once; 0 = as many as there are workers"),
    option(
        "max-jobs", &ServeOptions::jobsPerClient, {.range = {1, 256}},
        "Jobs that are kept for one client, whatever their state; 429 beyond it, and beyond its [share](#load) of all"),
    option("job-bytes", &ServeOptions::jobBytes, kRoom,
           "Requests and pictures of all jobs, kept in Redis, the directory of `--store` or memory, of one client its "
           "[share](#load); 507 beyond it"),
    option("job-age", &ServeOptions::jobAgeSeconds, {kSeconds, {1, kLongestAge}},
           "A job is removed with its pictures so long after its last frame, as 12h or 7d"),
};

inline constexpr std::array kTimeoutRows{
    option("request-timeout", &ServeOptions::requestTimeoutSeconds, kTimeout,
           "Time for a frame from the arrival of its request, or less by `Prefer: wait=SECONDS`; 504 beyond it"),
    option("evaluation-timeout", &ServeOptions::evaluationTimeoutSeconds, kTimeout,
           "Time for an evaluation from the arrival of its request; 504 beyond it"),
    option("sequence-timeout", &ServeOptions::sequenceTimeoutSeconds, kTimeout,
           "Time for all frames of a sequence from the arrival of its request; each has `--request-timeout` besides. "
           "One of far more work gets 413"),
    option("idle-timeout", &ServeOptions::idleTimeoutSeconds, kTimeout,
           "Time for which a connection without a request is kept; more than that of a proxy in front, which else "
           "meets closed connections (502)"),
    option("drain", &ServeOptions::drainSeconds, kPause,
           "Time after SIGTERM in which requests are served while `/readyz` fails, so that load balancers notice"),
    option("grace", &ServeOptions::graceSeconds, kPause,
           "Time after that for the requests in progress; [the rest](#stop) get 503"),
    option("until-stdin-closes", &ServeOptions::untilStdinCloses, {},
           "[End](#stop) within two seconds once standard input is closed, as it is when the program that holds the "
           "other end of the pipe ends, however it ends"),
};

/// Options under one heading of --help.
struct OptionGroup {
  std::string_view name;
  std::span<const OptionRow> rows;
};
inline constexpr std::array kOptionGroups{
    OptionGroup{"Address and storage", kStorageRows},
    OptionGroup{"Renderer", kRendererRows},
    OptionGroup{"Limits", kLimitRows},
    OptionGroup{"Jobs", kJobRows},
    OptionGroup{"Timeouts", kTimeoutRows},
};

constexpr bool isNumber(const OptionMember& member) {
  return std::holds_alternative<int ServeOptions::*>(member) ||
         std::holds_alternative<std::optional<int> ServeOptions::*>(member) ||
         std::holds_alternative<std::size_t ServeOptions::*>(member) ||
         std::holds_alternative<std::int64_t ServeOptions::*>(member);
}

/// True where each member of ServeOptions has one row, and each number a range that its type can hold.
consteval bool optionRowsAreComplete() {
  std::vector<OptionMember> members;
  for (const OptionGroup& group : kOptionGroups) {
    for (const OptionRow& row : group.rows) {
      if (std::find(members.begin(), members.end(), row.member) != members.end()) return false;
      if (isNumber(row.member) && !(row.value.range.min >= 0 && row.value.range.max <= kMostBytes)) return false;
      members.push_back(row.member);
    }
  }
  return members.size() == memberCount<ServeOptions>();
}
static_assert(optionRowsAreComplete());

} // namespace gnomon
