#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "protocol/report/frame_report.h"
#include "protocol/spec/limits.h"

/// Rows of the fields: reply_rows.h.
namespace gnomon {

enum class Backend { auto_, egl, osmesa };

/// Which device draws, and by which graphics context.
struct BackendOptions {
  DeviceChoice device = DeviceChoice::auto_; ///< gl where another option names a context or a GPU
  Backend backend = Backend::auto_;          ///< auto_ = EGL, or else OSMesa
  bool requireGpu = false;                   ///< refuse software renderers
};

/// The device that draws, and its limits.
struct RendererInfo {
  std::string backend{};
  std::string platform{};
  std::string vendor{};
  std::string renderer{};
  std::string version{};
  bool software = false;
  int maxTextureSize = 0;
  int maxSamples = 0;
  DeviceChoice device = DeviceChoice::gl;
  std::string fingerprint{};
};

struct CameraSummary {
  int node = 0;
  std::string name{};
  std::string type{};
};

struct LightSummary {
  int node = 0;
  std::string name{};
  std::string type{};
};

struct MemorySummary {
  std::uint64_t vertices = 0;
  std::uint64_t indices = 0;
  std::uint64_t images = 0;
  std::uint64_t volumes = 0;
  std::uint64_t environments = 0;
  std::uint64_t deformation = 0;
  std::uint64_t animations = 0;
  std::uint64_t structure = 0;
};

struct AnimationSummary {
  std::string name{};
  double durationSeconds = 0;
};

/// Contents of a scene, the reply to its upload. Counts are of the default glTF scene.
struct SceneSummary {
  std::string id{};
  std::uint64_t bytes = 0;
  std::uint64_t memoryBytes = 0;
  MemorySummary memory{};
  int scenes = 0;
  int defaultScene = 0;
  std::uint64_t nodes = 0;
  std::uint64_t meshes = 0;
  std::uint64_t instances = 0;
  std::uint64_t materials = 0;
  std::uint64_t textures = 0;
  std::uint64_t images = 0;
  std::uint64_t triangles = 0;
  std::uint64_t vertices = 0;
  std::uint64_t skins = 0;
  std::uint64_t joints = 0;
  std::uint64_t morphTargets = 0;
  std::array<double, 3> boundsMin{};
  std::array<double, 3> boundsMax{};
  std::vector<CameraSummary> cameras{};
  std::vector<LightSummary> lights{};
  std::optional<int> environmentLight{};
  std::vector<AnimationSummary> animations{};
  std::vector<std::string> materialVariants{};
  std::vector<std::string> volumeFiles{};
  std::vector<std::string> environmentFiles{};
  std::vector<std::string> extensionsUsed{};
  std::vector<std::string> extensionsIgnored{};
  std::vector<std::string> warnings{};
};

struct ImageReply {
  std::string view{};
  std::string contentType{};
  std::string data{};
};

/// A frame asked for as application/json.
struct FrameReply {
  FrameReport report{};
  std::vector<ImageReply> images{};
};

/// GET /v1/scenes: one page.
struct SceneList {
  std::vector<SceneSummary> scenes{};
  std::optional<std::string> next{};
};

/// GET /v1/capabilities.
struct Capabilities {
  std::string version{};
  RendererInfo renderer{};
  Limits limits = kLimits;
};

/// A node of the file, whichever of its scenes it belongs to.
struct NodeSummary {
  int node = 0;
  std::string name{};
  std::optional<int> parent{};
  std::uint64_t triangles = 0;
};

struct NodePage {
  int after = -1;
  int limit = 1000;
};

inline constexpr int kMostNodesOnPage = 10'000;

/// GET /v1/scenes/{id}/nodes: one page, ascending by index.
struct NodeList {
  std::vector<NodeSummary> nodes{};
  std::optional<int> next{};
};

} // namespace gnomon
