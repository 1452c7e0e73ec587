#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "protocol/report/frame_report.h"
#include "protocol/report/replies.h"
#include "renderer/bake/baked_light.h"
#include "renderer/environment/environment.h"
#include "renderer/image/image.h"
#include "renderer/prepare/lit_light.h"
#include "renderer/rays/traced_scene.h"
#include "renderer/resolve/resolve_frame.h"
#include "renderer/volume/volume_light.h"

/// What draws frames. A device decides nothing: what is seen, planned and reported is passed in plain values. Calls
/// come in the order in which they stand here, on the thread that made it.
namespace gnomon {

/// How long something took, by the processor's clock and, where it has one, by the device's. Milliseconds.
struct WorkTime {
  double cpuMilliseconds = 0;
  std::optional<double> gpuMilliseconds{};
};

/// What went into one tile of the plan.
struct TileFacts {
  std::uint64_t casterTriangles = 0;
  std::uint64_t culledTriangles = 0;
  std::size_t drawCalls = 0;
  bool reused = false;            ///< an earlier frame's tile serves; at most texels that none has read were added
  std::optional<WorkTime> time{}; ///< absent where nothing was drawn
};

/// What finding one light's visibility layer took, at one number of samples a pixel.
struct LayerFacts {
  int light = 0; ///< index into the effective lights
  double cpuMilliseconds = 0;
  std::optional<std::uint64_t> tracedPixels{}; ///< that rays decided; absent where none were asked
};

struct FrameFacts {
  std::vector<TileFacts> tiles; ///< one a tile of the plan
  std::vector<LayerFacts> layers;
  std::vector<PassReport> passes; ///< in the order in which they ran
  std::uint64_t surveyedTriangles = 0;
  std::uint64_t shadedTriangles = 0;
  std::size_t otherDrawCalls = 0; ///< of what is no pass of its own
  MemoryReport memory;
  std::vector<StageTime> stages;
};

/// A frame to be drawn. What it refers to outlives the drawing.
struct FrameWork {
  std::shared_ptr<const Scene> scene;
  const ResolvedFrame& frame;
  std::vector<int> layered; ///< lights whose technique needs a visibility layer, in the layers' order: baked ones last
  bool needsEdges = false;  ///< some light's technique needs the edges of meshes
  std::function<Result<std::shared_ptr<const TracedScene>>()> traced; ///< asked where rays are needed
  /// What was baked for a light whose technique is baked; asked after the survey.
  std::function<std::shared_ptr<const BakedLight>(int light)> baked;
  const FrameVolumes* volumes = nullptr;         ///< filled when the survey begins; null or empty = none
  const FrameEnvironment* environment = nullptr; ///< filled when the survey begins; null = the studio
  std::vector<std::uint32_t> parts{};            ///< what the survey reports separately: receiver groups, a bit each
};

/// Which live as long as the frame's volumes; none where it has none.
inline std::vector<const Medium*> mediaOf(const FrameWork& work) {
  return work.volumes != nullptr ? work.volumes->all() : std::vector<const Medium*>{};
}

/// Whether tiles that earlier frames drew may serve a frame. Its pictures are the same either way; its times are not.
enum class TileUse { kept, drawnAnew };

/// A picture that a frame shows. Views of source `rays` and `geometry` are made from what else a device returns, and
/// are not asked of it.
struct ViewRequest {
  View view = View::color;
  bool encoded = true;       ///< 8 or 16 bits a channel, tone mapped; else linear numbers
  bool opaque = true;        ///< a picture has no alpha channel
  bool antialiased = true;   ///< pictures: as the spec asks; false = one sample a pixel
  bool fullStrength = false; ///< lights as in atFullStrength
  bool fine = false;         ///< encoded: 16 bits a channel instead of 8
};

struct ShowInput {
  const ShadowPlan& plan;
  std::span<const LitLight> lights{};          ///< the frame's
  std::span<const std::uint32_t> lightLists{}; ///< lightLists; empty = every light is tried at every pixel
  int debugLight = -1;                         ///< what views of one light show; -1 = there is none; kEnvironmentLight
  const PlannedLight* planned = nullptr;       ///< of the plan: the same; null where it has no map
  const ShadowTile* tile = nullptr;            ///< of the plan: what view `tile` shows
  std::span<const ViewRequest> views{};
};

/// A place on a surface, of which one light is asked.
struct ProbePoint {
  glm::dvec3 relative{0}; ///< to the eye, metres
  glm::dvec3 normal{0};   ///< of the triangle, on the eye's side, unit length
  std::uint8_t group = 0; ///< receiver group
};

/// What a light's map does to an edge of its shadow at a pixel's centre: see EdgeOnTexels. Pixels, y DOWN the picture.
struct MapFootprint {
  glm::vec2 texelU{0}; ///< 0 where no tile serves the pixel
  glm::vec2 texelV{0};
  glm::vec2 shift{0};
  glm::vec3 normal{0}; ///< of the triangle; unit length
  float viewDepth = 0; ///< metres; 0 = nothing that receives the light's shadow
  int tile = 0;        ///< among the light's
  float penumbra = 0;  ///< texels: radius of the disc that filter pcss weighs; 0 = no caster is found, other filters
};

/// One frame on its way.
class FrameDrawing {
 public:
  virtual ~FrameDrawing() = default;

  /// What the camera sees, of all and of each part that the work asks for.
  virtual Result<SeenDepths> survey() = 0;
  /// The tiles of `input.plan`, drawn or taken over from an earlier frame: at least what the views of `input` read of
  /// them.
  virtual Status cast(const ShowInput& input, TileUse tiles) = 0;
  /// Lights the surfaces and makes every view of `input`, which is that of cast.
  virtual Status show(const ShowInput& input) = 0;
  /// The triangle that each pixel's centre shows; first row on top. After show.
  virtual Result<std::vector<PlacedTriangle>> shownTriangles() = 0;
  /// What the map of `input.debugLight`, which has one, does at each pixel; first row on top. After show.
  virtual Result<std::vector<MapFootprint>> footprints(const ShowInput& input) = 0;
  /// The share of `input.debugLight` that each point gets by the plan's tiles, 0..1: what view `shadow` shows where a
  /// pixel's centre meets the point. After cast; of `input` the plan and the lights count.
  virtual Result<std::vector<float>> probe(const ShowInput& input, std::span<const ProbePoint> points) = 0;
  /// The picture of request `index` of what was shown, first row on top.
  virtual Image picture(std::size_t index) = 0;
  /// The same, for the last time: spares a copy where there is one.
  virtual Image takePicture(std::size_t index) { return picture(index); }

  /// Ends a stage of the frame's timing; does not wait for what is still being drawn.
  virtual void endStage(std::string name) = 0;
  /// Waits until all is done; a problem where the device met one.
  virtual Result<FrameFacts> finish() = 0;
};

class Device {
 public:
  virtual ~Device() = default;
  virtual const RendererInfo& info() const = 0;
  /// Begins a frame, and ends its stage `upload`.
  virtual Result<std::unique_ptr<FrameDrawing>> begin(const FrameWork& work) = 0;
};

} // namespace gnomon
