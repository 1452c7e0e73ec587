#pragma once

#include <optional>
#include <vector>

namespace gnomon {

enum class ShadowSize { XSmall, Small, Medium, Large, XLarge };
enum class ShadowLightPolicy { all, first };
enum class ShadowImportance { low, medium, high };
enum class PartitionMode { manual, uniform, logarithmic };
enum class DepthRangeMode { automatic, manual };
enum class Stabilization { none, projectionSnapping, viewSnapping };
enum class FilterType { hard, pcf };

/// How the depth range is cut into cascades.
struct Partition {
  PartitionMode mode = PartitionMode::logarithmic;
  double pssmFactor = 0.5;      ///< logarithmic: 0 = logarithmic, 1 = uniform
  std::vector<double> splits{}; ///< manual: far ends as fractions of the range, increasing, one per cascade, at most 1

  bool operator==(const Partition&) const = default;
};

/// The depths that the cascades cover.
struct DepthRange {
  DepthRangeMode mode = DepthRangeMode::automatic; ///< automatic = the nearest and farthest surface in this frame
  std::optional<double> min{};                     ///< manual: metres from the camera's near plane, >= 0
  std::optional<double> max{};                     ///< manual: metres from the camera's near plane, > min

  bool operator==(const DepthRange&) const = default;
};

struct Filter {
  FilterType type = FilterType::pcf;
  int size = 5; ///< pcf: texels across, 3, 5 or 7

  bool operator==(const Filter&) const = default;
};

struct Shadow {
  bool enabled = true;
  double strength = 1; ///< 0 = no shadow, 1 = no direct light in shadow
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

  bool operator==(const Shadow&) const = default;
};

/// The one depth texture that holds every tile.
struct Atlas {
  int size = 4096;     ///< texels along a side at most, a power of two
  int baseSize = 1024; ///< texels along a side of a Large tile, a power of two

  bool operator==(const Atlas&) const = default;
};

} // namespace gnomon
