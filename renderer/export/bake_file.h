#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "protocol/base/bytes.h"
#include "protocol/base/result.h"

/// Part of the door: see render.h.
namespace gnomon {

struct BakedScene;

enum class BakeFile {
  png, ///< the share of one light that arrives, 8-bit grey: linear, row by row as the map has it
  exr, ///< the same in floats; several lights are layers: light0.Y, light1.Y
  glb  ///< the scene with texture coordinates for the map, and the light that arrives under MOZ_lightmap
};

/// Their media types, in that order.
inline constexpr std::array<std::string_view, 3> kBakeFileTypes{"image/png", "image/x-exr", "model/gltf-binary"};

inline constexpr std::size_t kMostExportedBytes = 256u << 20; ///< of a GLB

/// What was baked as a file. `light`: index of one of the baked lights; absent = the first for PNG, all for the others.
/// Problems: at /light where that light was not baked; where lights that share a file were baked into charts of
/// different sizes; where the scene's pictures are broken; tooLarge where a GLB would have more than
/// kMostExportedBytes.
Result<Bytes> bakeFile(const BakedScene& baked, BakeFile kind, std::optional<int> light);

} // namespace gnomon
