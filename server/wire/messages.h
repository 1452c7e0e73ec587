#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/base/result.h"
#include "protocol/report/replies.h"
#include "protocol/spec/output_options.h"

/// The messages between the process that listens (the front) and a worker, over a Channel. Each message is one JSON
/// object with one member; files go with some.
namespace gnomon {

/// How a worker draws and what it may keep; the first message to it.
struct WorkerOptions {
  DeviceChoice device = DeviceChoice::auto_;
  Backend backend = Backend::auto_;
  bool requireGpu = false;

  // Bytes
  std::uint64_t gpuSceneBytes = 1u << 30;      ///< scenes on the graphics device
  std::uint64_t tileCacheBytes = 1u << 28;     ///< shadow atlases for later frames
  std::uint64_t tracedSceneBytes = 1u << 30;   ///< scenes sorted for rays
  std::uint64_t lightMapBytes = 1u << 28;      ///< baked light maps
  std::uint64_t volumeBytes = 1u << 29;        ///< grids of volumes, and the light in them
  std::uint64_t environmentBytes = 1u << 28;   ///< environments prepared for shading
  std::uint64_t sceneMemoryBytes = 2ull << 30; ///< loaded scenes
  std::uint64_t frameMemoryBytes = 4ull << 30; ///< drawing and encoding the frames in progress
  std::uint64_t maxSceneBytes = kLimits.maxSceneBytes;
  std::uint64_t memoryBytes = 0; ///< of the whole process; 0 = as much as there is
  std::uint64_t vdbBytes = 0;    ///< of the process that reads a VDB file for it; 0 = as much as that allows itself

  bool keepsLightMaps = false; ///< the front stores light maps
};

/// The media type of results that are sent as events.
inline constexpr std::string_view kEventStream = "text/event-stream";

enum class OrderKind {
  load,         ///< loads a scene; the result is its SceneSummary
  frame,        ///< a picture, or report and pictures
  plan,         ///< a PlanReport
  evaluation,   ///< an EvaluationReport, as JSON, CSV, chart or events
  bake,         ///< a BakeReport, as JSON or events
  bakeFile,     ///< a bake as a file
  nodes,        ///< a NodeList; the request is a NodePage
  sequenceFrame ///< a frame of a sequence: its pictures' bytes one after the other, described as in sequence_news.h
};

/// Work for a worker. Two files go with it: the scene's bundle, and the JSON text of the request (a FrameSpec or an
/// EvaluationRequest; empty for `load`).
struct Order {
  std::uint64_t number = 0; ///< names it on this channel
  OrderKind kind = OrderKind::frame;
  std::string scene{};           ///< its id
  bool isStored = false;         ///< the bundle comes from a disk, and may be damaged
  bool strict = false;           ///< of a load: a file that violates glTF is refused
  double milliseconds = 0;       ///< until its deadline
  double queuedMilliseconds = 0; ///< that it waited in the front
  std::string mediaType{};       ///< of the result: one that the kind can be sent as
  std::string boundary{};        ///< between the parts of a multipart result
  std::optional<int> light{};    ///< of a bakeFile, as Baker::file takes it
  std::string traceId{};         ///< of the request, for the log

  std::optional<SensorRange> depthRange{}; ///< of a frame: its depths as a sensor of this range has them
  bool labels = false;                     ///< of a frame: the colors of its materials
};

/// An order is cancelled; its outcome still comes.
struct Cancel {
  std::uint64_t number = 0;
};

/// A scene was deleted: nothing of it may stay in memory.
struct Forget {
  std::string scene{};
};

/// What became of a request for a light map; its bytes go along where there are any.
struct LightMapFound {
  std::uint64_t number = 0;
};

struct ToWorker {
  std::optional<WorkerOptions> start{};
  std::optional<Order> order{};
  std::optional<Cancel> cancel{};
  std::optional<Forget> forget{};
  std::optional<LightMapFound> lightMap{};
};

/// The most bytes that an order's result may have.
inline constexpr std::size_t kMostResultBytes = 0x7fffffff;

/// The result of an order. Its bytes go along, unless there are problems or it was sent as events.
struct Outcome {
  std::uint64_t number = 0;
  std::vector<Problem> problems{};
  int retryAfterSeconds = 1; ///< where a problem says busy
  bool damaged = false;      ///< the bundle is not the one that the scene's id names
  std::string contentType{};
  std::vector<StageTime> stages{};
  std::vector<std::string> warnings{}; ///< of a frame's report
  std::string note{};                  ///< for the log alone
};

/// A server-sent event of an order.
struct OrderEvent {
  std::uint64_t number = 0;
  std::string name{};
  std::string data{}; ///< JSON
};

/// A sign of life, and what the worker holds.
struct Beat {
  std::uint64_t scenes = 0;          ///< loaded
  std::uint64_t sceneBytes = 0;      ///< of them
  std::uint64_t reusedMeshes = 0;    ///< found in a scene that was loaded before
  std::uint64_t reusedImages = 0;    ///< the same of images
  std::vector<double> costFactors{}; ///< milliseconds for a unit of each part of a FrameCost, learned there
};

/// A worker that can't start.
struct Refusal {
  std::vector<Problem> problems{};
};

/// Whether it is the name of a light map: "<scene's id>-<64 lower-case hexadecimal digits>".
bool isLightMapKey(std::string_view key);

/// The scene's id in it. REQUIRES: isLightMapKey(key).
inline std::string_view sceneOfLightMap(std::string_view key) {
  return key.substr(0, key.find('-'));
}

/// Asks for a stored light map.
struct LightMapRequest {
  std::uint64_t number = 0;
  std::string key{};
};

/// A light map to be stored; its bytes go along.
struct LightMapMade {
  std::string key{};
};

struct ToFront {
  std::optional<RendererInfo> ready{}; ///< the first frame is drawn
  std::optional<Refusal> refusal{};
  std::optional<Outcome> outcome{};
  std::optional<OrderEvent> event{};
  std::optional<Beat> beat{};
  std::optional<LightMapRequest> request{};
  std::optional<LightMapMade> made{};
};

std::string textOf(const ToWorker& message);
std::string textOf(const ToFront& message);

/// Nothing where the text is no such message: unknown members, values of other types, none or two of the members.
std::optional<ToWorker> readToWorker(std::string_view text);

/// The same, and where a value is none that a worker has: a stage that is no name, a time or a count without a bound, a
/// refusal without a problem, a key of no light map, an event that is not one line of JSON.
std::optional<ToFront> readToFront(std::string_view text);

/// Whether these can be times of a frame's stages: names as a header may hold them, and at most a few.
bool areStages(const std::vector<StageTime>& stages);
inline constexpr double kMostMilliseconds = 1e12; ///< of a time in a message

} // namespace gnomon
