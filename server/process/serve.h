#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "protocol/report/replies.h"
#include "protocol/spec/limits.h"
#include "server/http/reply.h"

namespace gnomon {

/// Everything that an operator can choose. The defaults suit one machine and its own users.
struct ServeOptions {
  // Address and storage
  std::string bind = "127.0.0.1";        ///< address to listen on; "0.0.0.0" = every IPv4 address, "::" = every address
  std::vector<std::string> allowedHosts; ///< names by which clients may reach it (origin_check.h); 421 for others
  std::vector<std::string> allowedOrigins; ///< pages of other servers that may use this one; 403 for others' requests
  std::vector<std::string> trustedProxies; ///< addresses and networks (client_address.h) that may name their clients
  std::string keysFile; ///< keys of clients (access_key.h), read again on SIGHUP; empty = anyone may do anything
  int port = 8080;      ///< 0..65535; 0 = any free one, which is printed
  std::string adminBind = "127.0.0.1"; ///< address of adminPort
  std::optional<int> adminPort; ///< 0..65535: /metrics is served here alone, and probes; 0 = any free one, in the log
  std::string store; ///< where scenes outlive a restart: a directory, created where missing, or the address of a Redis
                     ///< server (redis/address.h); empty = memory only
  std::uint64_t storeBytes = 0;     ///< of scenes in the store (507); 0 = as many as its disk or Redis takes
  std::int64_t storeAgeSeconds = 0; ///< scenes in it that nobody has used for so long are removed; 0 = never
  std::string redisPasswordFile;    ///< file with the password of that Redis server; empty = that of its address
  std::string redisAuthorities;     ///< PEM file of who may sign its certificate; empty = whom the system trusts

  // Workers and what draws in them
  std::size_t workers = 0;                      ///< processes that draw; 0 = a quarter of the cores, and at least two
  std::string workerProgram = "/proc/self/exe"; ///< what is started as "PROGRAM worker"
  BackendOptions backend;
  std::size_t gpuSceneBytes = 1u << 30;       ///< bytes of scenes kept on the graphics device
  std::size_t tileCacheBytes = 1u << 28;      ///< bytes of shadow atlases kept for later frames; 0 = none
  std::size_t tracedSceneBytes = 1u << 30;    ///< bytes of ray-tracing structures of scenes
  std::size_t lightMapBytes = 1u << 28;       ///< bytes of baked light maps
  std::size_t storedLightMapBytes = 1u << 30; ///< bytes of those in the store

  // Limits
  std::size_t queueLimit = 64;                       ///< >= 1; requests that may wait for a worker; 429 beyond it
  std::size_t sceneMemoryBytes = 2ull << 30;         ///< loaded scenes, the least recently used dropped first
  std::size_t bundleMemoryBytes = 1ull << 30;        ///< uploads without a directory, dropped in the same order
  std::size_t maxSceneBytes = kLimits.maxSceneBytes; ///< one upload
  std::size_t uploadMemoryBytes = 1ull << 30;        ///< bodies of all requests in progress together (429)
  std::size_t frameMemoryBytes = 4ull << 30; ///< pictures of all frames in progress together: a frame waits for room
                                             ///< (504), and may take no more than a worker's share (413)
  std::size_t replyMemoryBytes = 1ull << 30; ///< bodies of replies that clients are taking, together (503)
  std::size_t videoMemoryBytes =
      1ull << 30;                         ///< encoders of videos that are being sent, together (429), and of one (413)
  std::size_t replyCacheBytes = 1u << 28; ///< pictures kept for equal requests; 0 = every one is drawn
  std::size_t httpThreads = 128;          ///< >= 1; requests served at once; 503 beyond it, except for probes
  std::size_t maxConnectionsPerAddress = 0; ///< of those for one client (429); 0 = three quarters of them
  int maxEvaluations = 1;                   ///< >= 1; evaluations that may run at once (429)
  int maxSequences = 2;                     ///< >= 1; sequences that may run at once (429)
  std::string drakeSpecFile; ///< a FrameSpec (drake_form.h) for the color pictures of POST /render; empty = the default

  // Jobs
  std::string jobsAddress;             ///< of a Redis that keeps jobs for all servers that name it; empty = own ones
  std::size_t jobFrames = 0;           ///< frames of jobs that are drawn at once; 0 = as many as there are workers
  std::size_t jobsPerClient = 16;      ///< >= 1; jobs that are kept for one client (429)
  std::uint64_t jobBytes = 1ull << 30; ///< requests and pictures of all jobs (507)
  std::int64_t jobAgeSeconds = 86'400; ///< >= 1; a job is removed so long after its last frame

  // Timeouts
  int requestTimeoutSeconds = 60;     ///< >= 1; from the arrival of a request to its frame (504)
  int evaluationTimeoutSeconds = 600; ///< >= 1; from the arrival of an evaluation to its report (504)
  int sequenceTimeoutSeconds = 3600;  ///< >= 1; from the arrival of a sequence to its last frame
  int idleTimeoutSeconds = 75;        ///< >= 1; between two requests of a connection
  int drainSeconds = 0; ///< after SIGTERM, requests are served while /readyz fails, so that load balancers notice
  int graceSeconds = 8; ///< after that, for the requests in progress; the rest get 503, within two seconds more
  bool untilStdinCloses = false; ///< ends within two seconds once nobody holds the other end of standard input

  std::vector<StaticFile> page; ///< the web page
};

/// Serves until SIGTERM, SIGINT, or as untilStdinCloses has it, then ends in order: 0. Tells a service manager how it
/// is doing. A second signal ends at once. 1 = it could not start, or could not go on; the reason is on standard error.
/// Once requests are accepted, the address is printed on standard output: "listening on http://127.0.0.1:8080". Call it
/// before starting other threads: it blocks those two signals, and SIGHUP where there is a key file.
int serve(const ServeOptions& options);

} // namespace gnomon
