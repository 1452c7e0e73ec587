#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "protocol/report/error_metrics.h"
#include "protocol/spec/frame_spec.h"

namespace gnomon {

/// One stage's time. Names and order: queue load upload bake volume survey plan shadow shade predict reference readback
/// encode. `predict` is there with debug.predictEdges, `reference` where a view compares a shadow with rays, `queue` on
/// a server.
struct StageTime {
  std::string stage{};
  double milliseconds = 0;
};

/// One tile: a cascade, or a face of a spot or point light. What has no meaning for a tile without a surface in it,
/// which is not drawn, is 0 or absent.
struct TileReport {
  double near = 0;                   ///< metres: view depth where it begins; face: distance along its direction
  double far = 0;                    ///< metres: where it ends, along the same axis
  std::array<int, 4> tile{};         ///< x y width height in the atlas, texels, border included
  int border = 0;                    ///< texels on each side of the tile that only filters read
  std::array<double, 2> texelSize{}; ///< metres across and along; of a face: at its far end
  /// The tile's clip space from world space, column by column: x y -1..1 over the whole tile, z 0 (near the light)..1.
  std::optional<std::array<double, 16>> matrix{};
  /// Metres that a surface is moved along its normal, times the sine of normal and light; of a face: at its far end. Of
  /// a manual bias: its depth times its normalOffsetScale, whatever the angle and the place.
  double normalOffset = 0;
  /// Added for rounding, towards the light, as a fraction of the tile's depth; of a face: at its far end. A manual
  /// bias's depth and slope are added to it.
  double depthBias = 0;
  double depthBiasMetres = 0; ///< the same in metres
  std::optional<PredictedError> predictedError{};
  std::uint64_t casterTriangles = 0; ///< drawn into this tile
  std::uint64_t culledTriangles = 0; ///< not drawn: they can't shadow anything that this tile serves
  bool reused = false;               ///< drawn for an earlier frame; nothing was drawn for this one
  std::uint64_t drawCalls = 0;
  std::optional<double> cpuMilliseconds{}; ///< of drawing it; absent in a plan, and where not drawn
  std::optional<double> gpuMilliseconds{}; ///< the same on the device; absent where its driver has no timer, too
};

/// The texture that technique lightMap looks a shadow up in.
struct LightMapReport {
  bool reused = false; ///< an earlier frame baked it
  int width = 0;       ///< texels
  int height = 0;
  double texelsPerMetre = 0;
  std::uint64_t charts = 0;            ///< pieces that the surfaces were cut into
  std::uint64_t authoredInstances = 0; ///< placed meshes whose own TEXCOORD_1 is used
  std::uint64_t madeInstances = 0;     ///< the others, whose pieces were found here
  std::uint64_t bytes = 0;             ///< that it takes in memory
  double bakeMilliseconds = 0;         ///< that baking it took, when it was baked
};

/// A volume, and the light in it.
struct VolumeReport {
  std::array<int, 3> voxels{};    ///< of its grid along x, y and z; 0 = its node is hidden
  std::array<double, 2> values{}; ///< the least and the greatest of its grid
  bool reused = false;            ///< an earlier frame made its light
  std::array<int, 3> lightSize{}; ///< points at which its light is known, along x, y and z
  std::uint64_t lightBytes = 0;
  double lightMilliseconds = 0; ///< that making its light took, when it was made
};

/// What technique auto chose for a light, and why. The estimates are of two cores without a GPU, and of a GPU beside
/// them where one draws; other machines are about in proportion.
struct TechniqueChoice {
  ShadowTechnique technique = ShadowTechnique::shadowMap; ///< shadowMap or rayTraced
  std::string why{};
  double mapMilliseconds = 0;
  double rayMilliseconds = 0;
};

struct LightReport {
  int light = 0; ///< index into the effective spec's lights
  bool shadowed = false;
  int askedTileSize = 0;   ///< texels; 0 = no shadow was asked for
  int grantedTileSize = 0; ///< texels; 0 = none
  std::string note{};      ///< why no shadow was drawn, or what was decided differently; empty = as asked
  /// Directional: the view depths of its cascades without a guard, for the next frame's depthRange.previous.
  std::optional<PreviousRange> depthRange{};
  std::vector<TileReport> tiles{};
  std::optional<TechniqueChoice> choice{};     ///< where auto was asked for
  std::optional<std::uint64_t> tracedPixels{}; ///< pixels that rays decided; technique rayTraced, not in a plan
  std::optional<LightMapReport> lightMap{};    ///< technique lightMap, not in a plan
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
  std::optional<View> view{};              ///< of pass view
  double cpuMilliseconds = 0;              ///< from its first call to its last
  std::optional<double> gpuMilliseconds{}; ///< by the device's clock; absent where its driver has no timer
  std::uint64_t drawCalls = 0;
  std::uint64_t triangles = 0;
};

/// Bytes on the device. Driver padding is not known, and not counted.
struct MemoryReport {
  std::uint64_t scene = 0;   ///< geometry, materials and textures; kept between frames
  std::uint64_t atlas = 0;   ///< of this frame
  std::uint64_t targets = 0; ///< depth, surfaces, visibility and views of this frame
};

struct FrameCounts {
  std::uint64_t sceneTriangles = 0;    ///< in the chosen glTF scene
  std::uint64_t surveyedTriangles = 0; ///< drawn by the survey: inside the view
  std::uint64_t shadedTriangles = 0;   ///< drawn for the surfaces to light: in clusters that the survey saw
  std::uint64_t casterTriangles = 0;   ///< drawn into all tiles
  std::uint64_t drawCalls = 0;
};

/// Settings that were tried, and what they reached on this view.
struct QualityTrial {
  std::string settings{}; ///< a short name, e.g. "shadowMap hard 4 x 1024"
  Shadow shadow{};        ///< what every light that casts is given
  Atlas atlas{};
  double milliseconds = 0; ///< of a whole warm frame, median, without encoding
  double error = 0;        ///< share of misclassified receivers
};

/// How a target was met.
struct QualityReport {
  bool met = false;     ///< false = nothing reaches the target, and `chosen` is the best there is
  bool cached = false;  ///< chosen for an earlier frame of this scene and kind of view; nothing was tried
  std::size_t chosen{}; ///< index into `tried`
  std::vector<QualityTrial> tried{};
};

/// What a frame's rendering decided and took.
struct FrameReport {
  FrameSpec spec{};                   ///< effective: every default resolved, so that it can be asked for again
  std::array<double, 2> depthRange{}; ///< nearest and farthest surface in view, metres; 0 0 = nothing in view
  std::array<int, 2> atlasSize{};     ///< texels that the atlas really took; 0 0 = no atlas
  std::vector<LightReport> lights{};
  std::vector<VolumeReport> volumes{};            ///< one a volume of the spec
  std::optional<PredictedError> predictedError{}; ///< over all tiles; absent = none is drawn
  std::optional<ErrorMetrics> error{};    ///< of debug.light; present where a view shows an error or a reference
  std::optional<QualityReport> quality{}; ///< present where the spec names a target
  FrameCounts counts{};
  MemoryReport memory{};
  std::vector<PassReport> passes{};
  std::vector<StageTime> stages{};
  std::vector<std::string> warnings{};
};

/// What a frame would do, decided without drawing it: the boxes around what the camera may see stand in for its
/// surfaces. So every tile holds what the frame's would, and perhaps more, and the predicted errors are rather too
/// large.
struct PlanReport {
  FrameSpec spec{};                   ///< effective: every default resolved, so that it can be asked for again
  std::array<double, 2> depthRange{}; ///< nearest and farthest box in view, metres; 0 0 = nothing in view
  std::array<int, 2> atlasSize{};     ///< texels that the atlas would take; 0 0 = no atlas
  std::vector<LightReport> lights{};  ///< without times
  std::optional<PredictedError> predictedError{};
  std::vector<std::string> warnings{};
};

} // namespace gnomon
