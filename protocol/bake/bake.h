#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/json/json_codec.h"
#include "protocol/report/frame_report.h"
#include "protocol/spec/frame_spec.h"

/// Light maps that are made ahead of frames. Rows of the fields: bake_rows.h.
namespace gnomon {

struct BakedLightReport {
  int light = 0;
  LightMapReport lightMap{};
};

/// What baking ahead made.
struct BakeReport {
  std::string key{};
  std::vector<BakedLightReport> lights{};
  std::optional<LightMapReport> environment{};
  double milliseconds = 0;
};

/// How far a bake has come.
struct BakeStep {
  std::string key{};
  std::optional<int> light{}; ///< nothing = the environment
  double share = 0;
  int done = 0;
  int of = 0;
};

/// What a bake can be had as.
enum class BakeFile {
  /// The share of one light that arrives, 8-bit grey, or of the environment, 8-bit RGB: linear, row by row as the map
  /// has it.
  png,
  exr, ///< the same in floats, all in layers: light0.Y, light1.Y, environment.R, .G and .B
  glb  ///< the scene with texture coordinates for the map, and the light that arrives under MOZ_lightmap
};

/// Their media types, in that order.
inline constexpr std::array<std::string_view, 3> kBakeFileTypes{"image/png", "image/x-exr", "model/gltf-binary"};

/// Nothing where it is the media type of none of them.
constexpr std::optional<BakeFile> bakeFileOf(std::string_view mediaType) {
  const auto found = std::find(kBakeFileTypes.begin(), kBakeFileTypes.end(), mediaType);
  if (found == kBakeFileTypes.end()) return std::nullopt;
  return static_cast<BakeFile>(found - kBakeFileTypes.begin());
}

/// The parts of a frame's spec that decide what is baked for it; the rest has its defaults. Rays to the environment
/// stay where they are asked for, and then so does `ambient` where that is its light. A target stays, since no settings
/// can be chosen without a camera, and the bake refuses it.
FrameSpec bakedParts(const FrameSpec& spec);

/// Names a bake: SHA-256 of a scene's id and of those parts, as 64 lower-case hexadecimal digits.
std::string bakeKey(std::string_view sceneId, const FrameSpec& spec);

/// The report that a server wrote as JSON; what it says beyond our rows is passed over. Nothing = it is no report.
std::optional<BakeReport> readBakeReport(std::string_view json);

} // namespace gnomon
