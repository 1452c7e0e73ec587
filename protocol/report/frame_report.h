#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "protocol/spec/frame_spec.h"

/// Rows of the fields: report_rows.h and metric_rows.h.
namespace gnomon {

/// How large shadow texels show in the picture: Lloyd's m over the blocks of 8 x 8 pixels that show a surface, each at
/// the nearest surface in it. m is the largest extent in pixels of the texel under a point, on a surface there that
/// faces the light (Lloyd et al., "Warping and Partitioning for Low Error Shadow Maps", 2006); a surface that the light
/// grazes shows a larger one.
struct PredictedError {
  double median = 0;
  double p95 = 0;
  double max = 0;
  std::optional<double> edgeDisplacement{};
  std::optional<double> edgeLength{};
};

struct EdgeDisplacement {
  double mean = 0;
  double median = 0;
  double p95 = 0;
  double max = 0;
};

/// A shadow S held against the exact share V of the light, over the receivers: pixels whose surface receives shadows,
/// faces the light and lies within its reach. Shares are of the receivers, 0..1; both S and V say "lit" from 0.5 on.
struct ErrorMetrics {
  std::uint64_t receivers = 0;
  double misclassified = 0;
  double falseShadow = 0;
  double falseLit = 0;
  // The same ones by cause; their sum is `misclassified`:
  double acne = 0;
  double leak = 0;
  double edge = 0;
  double interior = 0;
  std::optional<EdgeDisplacement> edgeDisplacement{};
  double meanAbsolute = 0;
  double rms = 0;
  std::optional<double> shimmer{};
  std::optional<PredictedError> predicted{};
};

/// One stage's time. Names and order: queue load upload bake environment volume survey plan shadow shade predict
/// reference sunHours readback encode. `predict` is there with debug.predictEdges, `reference` where a view compares a
/// shadow with rays, `queue` on a server.
struct StageTime {
  std::string stage{};
  double milliseconds = 0;
};

/// One tile: a cascade, or a face of a spot or point light. What has no meaning for a tile without a surface in it,
/// which is not drawn, is 0 or absent.
struct TileReport {
  double near = 0;
  double far = 0;
  std::array<int, 4> tile{};
  int border = 0;
  std::array<double, 2> texelSize{};
  std::optional<std::array<double, 16>> matrix{};
  double normalOffset = 0;
  double depthBias = 0;
  double depthBiasMetres = 0;
  std::optional<PredictedError> predictedError{};
  std::uint64_t casterTriangles = 0;
  std::uint64_t culledTriangles = 0;
  bool reused = false;
  std::uint64_t drawCalls = 0;
  std::optional<double> cpuMilliseconds{};
  std::optional<double> gpuMilliseconds{};
};

struct LightMapReport {
  bool reused = false;
  int width = 0;
  int height = 0;
  double texelsPerMetre = 0;
  std::uint64_t charts = 0;
  std::uint64_t authoredInstances = 0;
  std::uint64_t madeInstances = 0;
  std::uint64_t bytes = 0;
  double bakeMilliseconds = 0;
};

struct VolumeReport {
  std::array<int, 3> voxels{};
  std::array<double, 2> values{};
  bool reused = false;
  std::array<int, 3> lightSize{};
  std::uint64_t lightBytes = 0;
  double lightMilliseconds = 0;
};

/// Directions are of the world: rotation and intensity are applied.
struct SunReport {
  std::array<double, 3> towards{};
  double angularDiameterDegrees = 0;
  std::array<double, 3> color{};
  double lux = 0;
};

struct EnvironmentReport {
  int width = 0;
  int height = 0;
  double meanRadiance = 0;
  std::optional<SunReport> sun{};
};

/// What technique auto chose for a light, and why. The estimates are of two cores without a GPU, and of a GPU beside
/// them where one draws; other machines are about in proportion.
struct TechniqueChoice {
  ShadowTechnique technique = ShadowTechnique::shadowMap;
  std::string why{};
  double mapMilliseconds = 0;
  double rayMilliseconds = 0;
};

struct LightReport {
  int light = 0;
  bool shadowed = false;
  int askedTileSize = 0;
  int grantedTileSize = 0;
  std::string note{};
  std::optional<PreviousRange> depthRange{};
  std::vector<TileReport> tiles{};
  std::optional<TechniqueChoice> choice{};
  std::optional<std::uint64_t> tracedPixels{};
  std::optional<LightMapReport> lightMap{};
  // Over its tiles:
  std::optional<PredictedError> predictedError{};
  std::uint64_t casterTriangles = 0;
  std::uint64_t drawCalls = 0;
  std::optional<double> cpuMilliseconds{};
  std::optional<double> gpuMilliseconds{};
};

/// One pass. Names and order: survey, shadow; surfaces, volumes, visibility and view as the views ask for them. Two
/// `surfaces` have other samples a pixel, and so have two `visibility`.
struct PassReport {
  std::string pass{};
  std::optional<View> view{};
  double cpuMilliseconds = 0;
  std::optional<double> gpuMilliseconds{};
  std::uint64_t drawCalls = 0;
  std::uint64_t triangles = 0;
  std::optional<std::uint64_t> rays{};
};

/// Bytes on the device. Driver padding is not known, and not counted.
struct MemoryReport {
  std::uint64_t scene = 0;
  std::uint64_t atlas = 0;
  std::uint64_t targets = 0;
};

struct FrameCounts {
  std::uint64_t sceneTriangles = 0;
  std::uint64_t surveyedTriangles = 0;
  std::uint64_t shadedTriangles = 0;
  std::uint64_t casterTriangles = 0;
  std::uint64_t drawCalls = 0;
};

/// Settings that were tried, and what they reached on this view.
struct QualityTrial {
  std::string settings{};
  Shadow shadow{};
  Atlas atlas{};
  double milliseconds = 0;
  double error = 0;
};

struct QualityReport {
  std::optional<bool> met{};
  bool cached = false;
  std::size_t chosen{};
  std::vector<QualityTrial> tried{};
};

/// What view sunHours shows. Hours are over the pixels that show a surface; 0 where none does.
struct SunHoursReport {
  int steps = 0;
  double daylightHours = 0;
  double meanHours = 0;
  double minHours = 0;
  double maxHours = 0;
};

/// What a frame's rendering decided and took.
struct FrameReport {
  FrameSpec spec{};
  std::array<double, 2> depthRange{};
  std::array<int, 2> atlasSize{};
  std::vector<LightReport> lights{};
  std::vector<VolumeReport> volumes{};
  std::optional<EnvironmentReport> environment{};
  std::optional<PredictedError> predictedError{};
  std::optional<ErrorMetrics> error{};
  std::optional<SunHoursReport> sunHours{};
  std::optional<QualityReport> quality{};
  FrameCounts counts{};
  MemoryReport memory{};
  std::vector<PassReport> passes{};
  std::vector<StageTime> stages{};
  std::vector<std::string> warnings{};
};

/// What a frame would do, decided without drawing it: the boxes around what the camera may see replace its
/// surfaces. So every tile holds what the frame's would, and perhaps more, and the predicted errors are rather too
/// large.
struct PlanReport {
  FrameSpec spec{};
  std::array<double, 2> depthRange{};
  std::array<int, 2> atlasSize{};
  std::vector<LightReport> lights{};
  std::optional<EnvironmentReport> environment{};
  std::optional<PredictedError> predictedError{};
  std::vector<std::string> warnings{};
};

} // namespace gnomon
