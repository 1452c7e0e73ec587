#include "server/process/serve_flags.h"

#include <CLI/CLI.hpp>

#include "protocol/fields/fields.h"

namespace gnomon {
namespace {

constexpr int kDay = 86'400; // seconds

// A choice more needs a flag more, below. The page is no choice; `backend` has two flags.
static_assert(memberCount<ServeOptions>() == 19);

void addWhere(CLI::App& serve, ServeOptions& options) {
  serve.add_option("--bind", options.bind, "Address to listen on; 0.0.0.0 is every IPv4 address, :: is every address")
      ->envname("GNOMON_BIND")
      ->type_name("ADDRESS")
      ->group("Where");
  // Not GNOMON_PORT: Kubernetes sets that one to an address when a service is called gnomon.
  serve.add_option("--port", options.port, "Port to listen on; 0 is any free one, which is printed")
      ->envname("GNOMON_LISTEN_PORT")
      ->check(CLI::Range(0, 65535))
      ->group("Where");
  serve.add_option("--store", options.storeDirectory, "Directory that keeps scenes over a restart; without it, memory")
      ->envname("GNOMON_STORE")
      ->type_name("DIR")
      ->group("Where");
}

void addWhatDraws(CLI::App& serve, ServeOptions& options) {
  serve
      .add_option_function<std::string>(
          "--backend",
          [&options](const std::string& name) {
            options.backend.backend = name == "egl"      ? Backend::egl
                                      : name == "osmesa" ? Backend::osmesa
                                                         : Backend::automatic;
          },
          "Graphics context; auto is EGL, then OSMesa")
      ->envname("GNOMON_BACKEND")
      ->check(CLI::IsMember({"auto", "egl", "osmesa"}))
      ->type_name("")
      ->default_str("auto")
      ->group("What draws");
  serve.add_flag("--require-gpu", options.backend.requireGpu, "Refuse to start where only software could draw")
      ->envname("GNOMON_REQUIRE_GPU")
      ->group("What draws");
}

/// Bytes, with a unit if that is handier: 512MB, 2GB (powers of 1024).
void addBytes(CLI::App& serve, const char* flag, const char* variable, std::size_t& bytes, const char* says) {
  serve.add_option(flag, bytes, says)
      ->envname(variable)
      ->transform(CLI::AsSizeValue(false).description(""))
      ->type_name("BYTES")
      ->group("How much");
}

void addHowMuch(CLI::App& serve, ServeOptions& options) {
  addBytes(serve, "--gpu-scene-bytes", "GNOMON_GPU_SCENE_BYTES", options.gpuSceneBytes,
           "Uploaded scenes that the renderer keeps; units are taken: 512MB, 2GB");
  addBytes(serve, "--tile-cache-bytes", "GNOMON_TILE_CACHE_BYTES", options.tileCacheBytes,
           "Shadow atlases kept for later frames; 0 = every tile is drawn anew");
  addBytes(serve, "--traced-scene-bytes", "GNOMON_TRACED_SCENE_BYTES", options.tracedSceneBytes,
           "Scenes kept sorted for rays, the least used dropped first");
  addBytes(serve, "--scene-memory-bytes", "GNOMON_SCENE_MEMORY_BYTES", options.sceneMemoryBytes,
           "Loaded scenes kept in memory, the least used dropped first");
  addBytes(serve, "--max-scene-bytes", "GNOMON_MAX_SCENE_BYTES", options.maxSceneBytes, "The largest upload");
  addBytes(serve, "--upload-memory-bytes", "GNOMON_UPLOAD_MEMORY_BYTES", options.uploadMemoryBytes,
           "Bodies of all requests that are under way together");
  addBytes(serve, "--frame-memory-bytes", "GNOMON_FRAME_MEMORY_BYTES", options.frameMemoryBytes,
           "Pictures that are drawn or encoded at once (429), or in one frame (413)");
  serve.add_option("--queue-limit", options.queueLimit, "Frames that may wait; one more is told to come again (429)")
      ->envname("GNOMON_QUEUE_LIMIT")
      ->check(CLI::Range(std::size_t{1}, std::size_t{100'000}))
      ->group("How much");
  serve
      .add_option("--http-threads", options.httpThreads, "Connections served at once; probes have a lane of their own")
      ->envname("GNOMON_HTTP_THREADS")
      ->check(CLI::Range(std::size_t{1}, std::size_t{4'096}))
      ->group("How much");
  serve
      .add_option("--max-evaluations", options.maxEvaluations,
                  "Evaluations at once, one more is told to come again (429); times are fairest when there is one")
      ->envname("GNOMON_MAX_EVALUATIONS")
      ->check(CLI::Range(1, 64))
      ->group("How much");
}

void addHowLong(CLI::App& serve, ServeOptions& options) {
  const auto add = [&](const char* flag, const char* variable, int& seconds, int least, const char* says) {
    serve.add_option(flag, seconds, says)
        ->envname(variable)
        ->check(CLI::Range(least, kDay))
        ->type_name("SECONDS")
        ->group("How long");
  };
  add("--request-timeout", "GNOMON_REQUEST_TIMEOUT", options.requestTimeoutSeconds, 1,
      "From a request's arrival to its frame, else 504");
  add("--evaluation-timeout", "GNOMON_EVALUATION_TIMEOUT", options.evaluationTimeoutSeconds, 1,
      "From an evaluation's arrival to its report, else 504");
  add("--drain", "GNOMON_DRAIN", options.drainSeconds, 0,
      "After SIGTERM, answer on with a failing /readyz, so that balancers turn away first");
  add("--grace", "GNOMON_GRACE", options.graceSeconds, 0, "Then, for what runs and waits; what is left gets a 503");
}

} // namespace

void addServeFlags(CLI::App& command, ServeOptions& options) {
  command.option_defaults()->always_capture_default();
  addWhere(command, options);
  addWhatDraws(command, options);
  addHowMuch(command, options);
  addHowLong(command, options);
}

} // namespace gnomon
