#pragma once

#include <array>
#include <optional>
#include <vector>

/// Rows of the fields: shadow_rows.h and enum_rows.h.
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

struct Partition {
  PartitionMode mode = PartitionMode::logarithmic;
  double pssmFactor = 0.5;
  std::vector<double> splits{};

  bool operator==(const Partition&) const = default;
};

struct PreviousRange {
  double near = 0;
  double far = 0;

  bool operator==(const PreviousRange&) const = default;
};

struct DepthRange {
  DepthRangeMode mode = DepthRangeMode::automatic;
  std::optional<double> min{};
  std::optional<double> max{};
  std::optional<PreviousRange> previous{};
  std::optional<double> guardDistance{};

  bool operator==(const DepthRange&) const = default;
};

struct Filter {
  FilterType type = FilterType::pcf;
  int size = 5;
  std::optional<double> radius{};

  bool operator==(const Filter&) const = default;
};

/// How far a receiver is moved before it is held against the map, so that no surface shadows itself.
struct Bias {
  BiasMode mode = BiasMode::automatic;
  // manual, absent = 0; lengths in the world, of one meaning for all types of light:
  std::optional<double> depth{};
  std::optional<double> slope{};
  std::optional<double> normalOffsetScale{};

  bool operator==(const Bias&) const = default;
};

struct LightMapOptions {
  int size = 1024;
  std::optional<double> texelsPerMetre{};
  int samples = 64;

  bool operator==(const LightMapOptions&) const = default;
};

struct Shadow {
  bool enabled = true;
  ShadowTechnique technique = ShadowTechnique::auto_;
  double strength = 1;
  std::array<double, 3> color{0, 0, 0};
  std::optional<ShadowSize> size{};
  ShadowImportance importance = ShadowImportance::high;
  int cascadeCount = 4;
  Partition partition;
  DepthRange depthRange;
  Stabilization stabilization = Stabilization::none;
  bool blendCascades = true;
  Filter filter;
  Bias bias;
  BlendedCasters blendedCasters = BlendedCasters::dither;
  Terminator terminator = Terminator::smooth;
  LightMapOptions lightMap;
  int raySamples = 16;

  bool operator==(const Shadow&) const = default;
};

struct Atlas {
  int size = 4096;
  int baseSize = 1024;
  int samples = 1;

  bool operator==(const Atlas&) const = default;
};

} // namespace gnomon
