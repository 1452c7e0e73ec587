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

/// Everything that an operator can choose; serve_option_rows.h says what each is, its unit and its range. The defaults
/// suit one machine and its own users.
struct ServeOptions {
  // Address and storage
  std::string bind = "127.0.0.1";
  std::vector<std::string> allowedHosts;   ///< origin_check.h
  std::vector<std::string> allowedOrigins; ///< origin_check.h
  std::vector<std::string> trustedProxies; ///< client_address.h
  std::string keysFile;                    ///< access_key.h
  std::string drakeSpecFile;               ///< drake_form.h
  int port = 8080;
  std::string adminBind = "127.0.0.1";
  std::optional<int> adminPort;
  std::string store; ///< a directory, or an address of redis/address.h
  std::uint64_t storeBytes = 0;
  std::int64_t storeAgeSeconds = 0;
  std::string redisPasswordFile;
  std::string redisAuthorities;

  // Workers and what draws in them
  std::size_t workers = 0;
  std::string workerProgram = "/proc/self/exe";
  DeviceChoice device = DeviceChoice::auto_;
  Backend backend = Backend::auto_;
  bool requireGpu = false;

  // Limits
  std::size_t gpuSceneBytes = 1u << 30;
  std::size_t tileCacheBytes = 1u << 28;
  std::size_t tracedSceneBytes = 1u << 30;
  std::size_t lightMapBytes = 1u << 28;
  std::size_t storedLightMapBytes = 1u << 30;
  std::size_t volumeBytes = 1u << 30;
  std::size_t environmentBytes = 1u << 29;
  std::size_t sceneMemoryBytes = 2ull << 30;
  std::size_t bundleMemoryBytes = 1ull << 30;
  std::size_t maxSceneBytes = kLimits.maxSceneBytes;
  std::size_t uploadMemoryBytes = 1ull << 30;
  std::size_t frameMemoryBytes = 16ull << 30;
  std::size_t replyMemoryBytes = 1ull << 30;
  std::size_t videoMemoryBytes = 1ull << 30;
  std::size_t replyCacheBytes = 1u << 28;
  std::size_t queueLimit = 64;
  std::size_t httpThreads = 128;
  std::size_t maxConnectionsPerAddress = 0;
  int maxEvaluations = 1;
  int maxSequences = 2;

  // Jobs
  std::string jobsAddress; ///< redis/address.h
  std::size_t jobFrames = 0;
  std::size_t jobsPerClient = 16;
  std::uint64_t jobBytes = 1ull << 30;
  std::int64_t jobAgeSeconds = 86'400;

  // Timeouts
  int requestTimeoutSeconds = 60;
  int evaluationTimeoutSeconds = 600;
  int sequenceTimeoutSeconds = 3600;
  int idleTimeoutSeconds = 75;
  int drainSeconds = 0;
  int graceSeconds = 8;
  bool untilStdinCloses = false;
};

struct ServeInputs;

/// Serves what serve_inputs.h has read by these options, with this web page, until SIGTERM, SIGINT, or as
/// untilStdinCloses has it, then ends in order: 0. Notifies a service manager how it is doing. A second signal ends at
/// once. 1 = it could not start, or could not go on; the reason is on standard error. Once requests are accepted, the
/// address is printed on standard output: "listening on http://127.0.0.1:8080". SIGHUP reads the keys again, or, where
/// there are none, changes nothing. Call it before starting other threads: it blocks these signals.
int serve(const ServeOptions& options, ServeInputs inputs, std::vector<StaticFile> page);

} // namespace gnomon
