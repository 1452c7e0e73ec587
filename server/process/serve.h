#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "protocol/report/capabilities.h"
#include "protocol/spec/limits.h"
#include "server/http/reply.h"

namespace gnomon {

/// Everything that an operator can choose. Each member has a default that suits one machine and its own users.
struct ServeOptions {
  // Where
  std::string bind = "127.0.0.1"; ///< address to listen on; "0.0.0.0" = every IPv4 address, "::" = every address
  int port = 8080;                ///< 0..65535; 0 = any free one, which is printed
  std::string storeDirectory;     ///< where scenes are kept over a restart; made if need be; empty = memory only

  // What draws
  BackendOptions backend;
  std::size_t gpuSceneBytes = 1u << 30;    ///< bytes of uploaded scenes that the renderer keeps
  std::size_t tileCacheBytes = 1u << 28;   ///< bytes of shadow atlases that the renderer keeps; 0 = none
  std::size_t tracedSceneBytes = 1u << 30; ///< bytes of scenes sorted for rays that the renderer keeps

  // How much
  std::size_t queueLimit = 64;               ///< >= 1; frames that may wait; one more is told to come again (429)
  std::size_t sceneMemoryBytes = 2ull << 30; ///< loaded scenes kept in memory, the least used dropped first
  std::size_t maxSceneBytes = kLimits.maxSceneBytes; ///< one upload
  std::size_t uploadMemoryBytes = 1ull << 30;        ///< bodies of all requests that are under way together
  std::size_t frameMemoryBytes =
      4ull << 30;                ///< pictures that are drawn or encoded at once (429), or in one frame (413)
  std::size_t httpThreads = 128; ///< >= 1; connections served at once; probes have a lane of their own
  int maxEvaluations = 1;        ///< >= 1; at once; times are fairest when there is one (429)

  // How long
  int requestTimeoutSeconds = 60;     ///< >= 1; from the request's arrival to its frame, else 504
  int evaluationTimeoutSeconds = 600; ///< >= 1; from the arrival of an evaluation to its report, else 504
  int drainSeconds = 0;  ///< after SIGTERM, answer on with a failing /readyz, so that balancers turn away first
  int graceSeconds = 30; ///< then, for what runs and waits; what is left after it is refused with 503

  std::vector<StaticFile> page; ///< the web page
};

/// Serves until SIGTERM or SIGINT, then ends in order: 0. A second signal ends at once. 1 = it could not start, or
/// could not go on; the reason is on standard error. The address is printed on standard output once requests are taken:
/// "listening on http://127.0.0.1:8080". Call it from a thread that has made no others: it blocks those two signals.
int serve(const ServeOptions& options);

} // namespace gnomon
