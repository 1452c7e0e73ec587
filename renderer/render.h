#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "protocol/base/result.h"
#include "protocol/base/scene_bundle.h"
#include "protocol/report/frame_report.h"
#include "protocol/report/replies.h"
#include "protocol/spec/frame_spec.h"
#include "protocol/spec/limits.h"
#include "renderer/charts/charts.h"
#include "renderer/core/stop.h"
#include "renderer/device/device.h"
#include "renderer/evaluation/evaluate.h"
#include "renderer/evaluation/quality.h"
#include "renderer/export/export_files.h"
#include "renderer/frame/frame.h"
#include "renderer/frame/light_map_store.h"
#include "renderer/image/image.h"
#include "renderer/image/image_codec.h"
#include "renderer/image/picture_encode.h"
#include "renderer/scene/shared_content.h"
#include "renderer/video/video_file.h"
#include "renderer/volume/vdb_file.h"

/// The only door into the renderer.
namespace gnomon {

/// Loads a glTF from memory. Any thread. Refuses, with every problem and its place, what it can't show rightly. `id`:
/// names these very bytes in a LightMapStore; empty = nothing of the scene is kept there.
/// `goOn`: false ends the loading with a problem of code unavailable. `known`: where meshes and images that an earlier
/// scene has are found, and those of this one are kept; frames of scenes that share them share what drawing made of
/// them.
Result<ScenePtr> loadScene(const SceneBundle& bundle, const Limits& limits = kLimits, const std::string& id = {},
                           const GoOn& goOn = {}, KnownContent* known = nullptr);

/// What the scene holds, and its id. Any thread.
const SceneSummary& summaryOf(const Scene& scene);

/// A page of the file's nodes, which ends early where their names are long. Any thread.
NodeList nodesOf(const Scene& scene, const NodePage& page);

struct RendererOptions {
  BackendOptions backend;
  std::size_t gpuSceneBytes = 1u << 30;       ///< uploaded scenes kept, least recently used dropped first
  std::size_t tracedSceneBytes = 1u << 30;    ///< scenes kept sorted for rays, dropped in the same order
  std::size_t lightMapBytes = 1u << 28;       ///< baked shadows kept, dropped in the same order
  std::shared_ptr<LightMapStore> lightMaps{}; ///< where baked shadows outlive the renderer; nullptr = nowhere
  std::size_t volumeBytes = 1u << 29;         ///< half of it grids of volumes kept, half the light in them
  std::size_t environmentBytes = 1u << 28;    ///< environments kept, dropped in the same order
  std::size_t tileCacheBytes = 1u << 28;      ///< shadow atlases kept for later frames; 0 = every tile is drawn again
};

struct FrameCaches;
class EnvironmentCache;

/// Bakes for the renderer that it came from, also while that draws and after it is gone. Any thread.
class Baker {
 public:
  /// Bakes every light of `spec` whose technique is lightMap, or finds what was baked earlier; a frame of that spec
  /// then reuses it. Camera, size and views do not matter. The report's key is left empty. Problems: those of a frame,
  /// one at /shadow/technique where no light is baked, and one of code unavailable where `listener` asked to stop.
  Result<BakeReport> bake(const ScenePtr& scene, const FrameSpec& spec, const BakeListener& listener = {}) const;

  /// The same as a file: bakeFile (export/export_files.h) with its problems.
  Result<Bytes> file(const ScenePtr& scene, const FrameSpec& spec, BakeFile kind, std::optional<int> light = {},
                     const BakeListener& listener = {}) const;

 private:
  friend class Renderer;
  explicit Baker(std::shared_ptr<FrameCaches> caches) : caches_(std::move(caches)) {}
  std::shared_ptr<FrameCaches> caches_;
};

/// Owns what draws. Everything but `info` only on the thread that made it.
class Renderer {
 public:
  /// Over the devices that the options leave to choose from: see DeviceChoice.
  static Result<Renderer> create(const RendererOptions& options);
  /// Over any device. `tracedSceneBytes`: as in RendererOptions.
  explicit Renderer(std::unique_ptr<Device> device, std::size_t tracedSceneBytes = RendererOptions{}.tracedSceneBytes);
  Renderer(Renderer&&) noexcept;
  Renderer& operator=(Renderer&&) noexcept;
  ~Renderer();

  /// Of the device that draws what doesn't name one.
  const RendererInfo& info() const;

  /// Of the device that draws `spec`, which is opened now if need be. A problem at /device as render gives.
  Result<RendererInfo> infoFor(const FrameSpec& spec);

  /// `spec` has passed protocol/validate; what depends on the scene (a node that is no camera) is checked here.
  /// `goOn`: false ends the frame with a problem of code unavailable; nothing half made is kept for later frames.
  Result<Frame> render(const ScenePtr& scene, const FrameSpec& spec, TileUse tiles = TileUse::kept,
                       const GoOn& goOn = {});

  /// Makes light maps ahead of the frames that look them up.
  Baker baker() const;

  /// The environments of its frames. Any thread may use it.
  std::shared_ptr<EnvironmentCache> environments() const;

  /// Shimmer of `spec`, its camera replaced by each one of the path in turn (at least two); each frame is surveyed,
  /// planned and cast as for a picture. Where a depth range has a `previous`, each frame takes the one before it for
  /// that. Points: a few thousand that the first camera sees, face the light, and are in sight of every other camera.
  /// Shadows are taken at full strength. A problem where there is no such point or no light that casts; `unavailable`
  /// where `progress` asked to stop.
  Result<Shimmer> shimmer(const ScenePtr& scene, const FrameSpec& spec, std::span<const Camera> path,
                          const Progress& progress = {});

 private:
  struct Impl;
  explicit Renderer(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

/// What an evaluation has `renderer` do for it. Refers to both.
EvaluationTools evaluationTools(Renderer& renderer, const ScenePtr& scene);

/// A file of a frame's pictures.
struct EncodedPicture {
  std::string view; ///< its name; of a file that holds every view, the first one's
  Bytes file;       ///< of the format that the frame's spec asks for
};

/// The frame's files in the format of its spec: one of each of the first `most` views, or one of all. Any thread.
/// `goOn`: false ends the encoding with a problem of code unavailable.
Result<std::vector<EncodedPicture>> encodePictures(const Frame& frame, std::size_t most, const GoOn& goOn = {});

} // namespace gnomon
