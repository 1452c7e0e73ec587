#pragma once

#include <array>
#include <optional>
#include <vector>

namespace gnomon {

enum class ShadowTechnique { auto_, shadowMap, shadowVolume, rayTraced, lightMap };
enum class ShadowSize { XSmall, Small, Medium, Large, XLarge };
enum class ShadowLightPolicy { all, first };
enum class ShadowImportance { low, medium, high };
enum class PartitionMode { manual, uniform, logarithmic };
enum class DepthRangeMode { automatic, manual };
enum class Stabilization { none, projectionSnapping, viewSnapping };
enum class FilterType { hard, pcf, vsm, evsm, msm, pcss };
enum class BiasMode { automatic, manual };
enum class BlendedCasters { dither, threshold };
enum class Terminator { smooth, flat };

/// How the depth range is cut into cascades.
struct Partition {
  PartitionMode mode = PartitionMode::logarithmic;
  double pssmFactor = 0.5;      ///< logarithmic: 0 = logarithmic, 1 = uniform
  std::vector<double> splits{}; ///< manual: far ends as fractions of the range, increasing, one per cascade, at most 1

  bool operator==(const Partition&) const = default;
};

/// A range that an earlier frame's report gave.
struct PreviousRange {
  double near = 0; ///< metres, view depth
  double far = 0;  ///< metres, view depth, > near

  bool operator==(const PreviousRange&) const = default;
};

/// The depths that the cascades cover.
struct DepthRange {
  DepthRangeMode mode = DepthRangeMode::automatic; ///< automatic = the nearest and farthest surface in this frame
  std::optional<double> min{};                     ///< manual: metres from the camera's near plane, >= 0
  std::optional<double> max{};                     ///< manual: metres from the camera's near plane, > min
  /// automatic, in a sequence: kept where this frame's surfaces lie within it and the guard; else a new one is made.
  std::optional<PreviousRange> previous{};
  std::optional<double> guardDistance{}; ///< metres added to both ends of `previous`; absent = 1

  bool operator==(const DepthRange&) const = default;
};

struct Filter {
  FilterType type = FilterType::pcf;
  int size = 5; ///< texels across, 3, 5 or 7; not for hard and pcss, nor with a radius
  std::optional<double>
      radius{}; ///< metres in the world, instead of size: one softness for all tiles; not for hard and pcss

  bool operator==(const Filter&) const = default;
};

/// How far a receiver is moved before it is held against the map, so that no surface shadows itself.
struct Bias {
  BiasMode mode = BiasMode::automatic; ///< automatic = from the texels' size, the filter's reach and the slope
  // manual, absent = 0; lengths in the world, of one meaning for all types of light:
  std::optional<double> depth{};             ///< metres towards the light
  std::optional<double> slope{};             ///< metres towards the light, times the tangent of normal and light
  std::optional<double> normalOffsetScale{}; ///< times depth: metres along the surface's normal

  bool operator==(const Bias&) const = default;
};

/// The texture that technique lightMap keeps a light's shadow in.
struct LightMapOptions {
  int size = 1024;                        ///< texels along its longer side at most, 16..8192
  std::optional<double> texelsPerMetre{}; ///< of the surfaces, instead of size
  int samples = 64;                       ///< rays a texel towards a light that has a size; 1..1024

  bool operator==(const LightMapOptions&) const = default;
};

struct Shadow {
  bool enabled = true;
  ShadowTechnique technique = ShadowTechnique::auto_;
  double strength = 1; ///< 0 = no shadow, 1 = no direct light in shadow
  /// Linear RGB, 0..1: what share of the direct light a full shadow of strength 1 leaves.
  std::array<double, 3> color{0, 0, 0};
  /// Of one tile: Large = atlas.baseSize, each step doubles. Absent = by the light: directional Large, spot Medium,
  /// point Small.
  std::optional<ShadowSize> size{};
  ShadowImportance importance = ShadowImportance::high; ///< each step down halves the tile; the least yields first
  int cascadeCount = 4;                                 ///< 1..8
  Partition partition;
  DepthRange depthRange;
  Stabilization stabilization = Stabilization::none;
  bool blendCascades = true; ///< cross-fade over the last 20 % of each cascade
  Filter filter;
  Bias bias;
  BlendedCasters blendedCasters = BlendedCasters::dither;
  Terminator terminator = Terminator::smooth; ///< of meshes with normals at their vertices
  LightMapOptions lightMap;
  int raySamples = 16; ///< rayTraced: most rays a pixel towards a light that has a size; 1..1024

  bool operator==(const Shadow&) const = default;
};

/// The one depth texture that holds every tile.
struct Atlas {
  int size = 4096;     ///< texels along a side at most, a power of two
  int baseSize = 1024; ///< texels along a side of a Large tile, a power of two
  int samples = 1;     ///< depths a texel: 1 or 4

  bool operator==(const Atlas&) const = default;
};

} // namespace gnomon
