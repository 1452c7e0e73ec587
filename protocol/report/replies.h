#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "protocol/report/frame_report.h"
#include "protocol/spec/limits.h"

namespace gnomon {

enum class Backend { auto_, egl, osmesa };

/// Which device draws, and by which graphics context.
struct BackendOptions {
  DeviceChoice device = DeviceChoice::auto_; ///< gl where another option names a context or a GPU
  Backend backend = Backend::auto_;          ///< auto_ = EGL, or else OSMesa
  bool requireGpu = false;                   ///< refuse software renderers
};

/// What the device that draws is and can do.
struct RendererInfo {
  std::string backend{};  ///< "cpu" | "egl" | "osmesa"
  std::string platform{}; ///< "cpu" | "device" | "surfaceless" | "osmesa"
  std::string vendor{};   ///< GL_VENDOR; of a processor its maker
  std::string renderer{}; ///< GL_RENDERER; of a processor its name
  std::string version{};  ///< GL_VERSION; of a processor the instruction set that is used, e.g. "AVX2"
  bool software = false;  ///< true = no GPU
  int maxTextureSize = 0; ///< texels
  int maxSamples = 0;
  DeviceChoice device = DeviceChoice::gl; ///< cpu or gl
  std::string fingerprint{};              ///< changes whenever the same request could give other bytes
};

struct CameraSummary {
  int node = 0; ///< index into the file's nodes; camera.node takes it as node:INDEX
  std::string name{};
  std::string type{}; ///< "perspective" | "orthographic"
};

struct LightSummary {
  int node = 0;
  std::string name{};
  std::string type{}; ///< "directional" | "spot" | "point"
};

/// Bytes of a loaded scene by what they hold; they add up to its memoryBytes.
struct MemorySummary {
  std::uint64_t vertices = 0;    ///< positions and attributes
  std::uint64_t indices = 0;     ///< and what is found from them
  std::uint64_t images = 0;      ///< decoded
  std::uint64_t volumes = 0;     ///< files of volumes
  std::uint64_t deformation = 0; ///< of skins and morph targets: what poses are made from
  std::uint64_t animations = 0;  ///< keyframes, and what else poses are made from
  std::uint64_t structure = 0;   ///< nodes, instances, materials
};

struct AnimationSummary {
  std::string name{};
  double durationSeconds = 0; ///< time of its last keyframe
};

/// What an upload is told about its scene. Counts are of the default glTF scene.
struct SceneSummary {
  std::string id{};              ///< SHA-256 of the bundle, 64 lower-case hexadecimal digits
  std::uint64_t bytes = 0;       ///< of the bundle
  std::uint64_t memoryBytes = 0; ///< of the loaded scene
  MemorySummary memory{};        ///< the same by part
  int scenes = 0;
  int defaultScene = 0;
  std::uint64_t nodes = 0;
  std::uint64_t meshes = 0;
  std::uint64_t instances = 0; ///< primitives, each as often as it is placed
  std::uint64_t materials = 0;
  std::uint64_t textures = 0;
  std::uint64_t images = 0;
  std::uint64_t triangles = 0;
  std::uint64_t vertices = 0;
  std::uint64_t skins = 0;
  std::uint64_t joints = 0;          ///< over all skins
  std::uint64_t morphTargets = 0;    ///< over all meshes
  std::array<double, 3> boundsMin{}; ///< metres
  std::array<double, 3> boundsMax{};
  std::vector<CameraSummary> cameras{};
  std::vector<LightSummary> lights{};
  std::vector<AnimationSummary> animations{};
  std::vector<std::string> materialVariants{}; ///< names of the file's KHR_materials_variants
  std::vector<std::string> volumeFiles{};      ///< names of the bundle's files that hold grids, for volumes
  std::vector<std::string> extensionsUsed{};
  std::vector<std::string> extensionsIgnored{}; ///< those of them that the loader does not know
  std::vector<std::string> warnings{};          ///< what the file holds that is drawn without or drawn differently
};

/// A picture within a JSON reply.
struct ImageReply {
  std::string view{};        ///< of an EXR, which holds every view, the first
  std::string contentType{}; ///< of the format
  std::string data{};        ///< the file in base64
};

/// A frame asked for as application/json.
struct FrameReply {
  FrameReport report{};
  std::vector<ImageReply> images{}; ///< a PNG for each view, or one EXR of them all
};

/// GET /v1/scenes: one page.
struct SceneList {
  std::vector<SceneSummary> scenes{};
  std::optional<std::string> next{}; ///< what the next page comes after; absent = this is the last
};

/// GET /v1/capabilities.
struct Capabilities {
  std::string version{}; ///< Gnomon's own
  RendererInfo renderer{};
  Limits limits = kLimits;
};

} // namespace gnomon
