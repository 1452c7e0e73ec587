#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

namespace gnomon {

/// What a bake can be had as.
enum class BakeFile {
  png, ///< the share of one light that arrives, 8-bit grey: linear, row by row as the map has it
  exr, ///< the same in floats; several lights are layers: light0.Y, light1.Y
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

} // namespace gnomon
