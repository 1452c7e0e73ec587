#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "renderer/prepare/frame_geometry.h"

namespace gnomon {

/// What a draw list is for: it decides which state and which textures its groups need.
enum class DrawUse {
  survey,        ///< culled by facing; textures only for materials with alpha
  cast,          ///< both faces cast, but of solids only the front ones; textures only for materials with alpha
  castFromPoint, ///< both faces cast: the light may stand inside a solid; textures only for materials with alpha
  surface        ///< culled by facing; a group for each material
};

/// A run of an indexed triangle list, drawn for one instance. Laid out as devices read indirect draws (OpenGL 4.5,
/// section 10.4; VkDrawIndexedIndirectCommand), so that a list of them is handed over whole.
struct DrawRange {
  std::uint32_t indexCount = 0;
  std::uint32_t instanceCount = 1;
  std::uint32_t firstIndex = 0;
  std::int32_t baseVertex = 0;
  std::uint32_t instance = 0; ///< index into the instances that the draw reads
};

/// The triangles of a group that are drawn: those whose corners go round this way as they are seen.
enum class Facing { both, counterClockwise, clockwise };

/// Ranges that share state and material.
struct DrawGroup {
  int material = -1; ///< -1 = any opaque one: nothing but positions matters
  Facing facing = Facing::both;
  bool tangents = false;
  std::size_t firstRange = 0;
  std::size_t rangeCount = 0;
};

struct DrawList {
  std::vector<DrawRange> ranges;
  std::vector<DrawGroup> groups;
  std::uint64_t triangles = 0;
};

/// The draws for every slot that `keep` marks (one byte a slot); neighbouring clusters become one draw. Pure.
DrawList buildDrawList(const Scene& scene, const SceneView& view, const FrameGeometry& geometry, DrawUse use,
                       std::span<const std::uint8_t> keep);

} // namespace gnomon
