#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "renderer/gl/draw.h"
#include "renderer/gl/pipeline_state.h"
#include "renderer/passes/frame_geometry.h"

namespace gnomon {

/// What a draw list is for: it decides which state and which textures its groups need.
enum class DrawUse {
  survey,        ///< culled by facing; textures only for materials with alpha
  cast,          ///< both faces cast, but of solids only the front ones; textures only for materials with alpha
  castFromPoint, ///< both faces cast: the light may stand inside a solid; textures only for materials with alpha
  surface        ///< culled by facing; a group for each material
};

/// Commands that share state and material.
struct DrawGroup {
  int material = -1; ///< -1 = any opaque one: nothing but positions matters
  gl::Cull cull = gl::Cull::none;
  gl::FrontFace frontFace = gl::FrontFace::counterClockwise;
  bool tangents = false;
  std::size_t firstCommand = 0;
  std::size_t commandCount = 0;
};

/// Each command's baseInstance is its instance.
struct DrawList {
  std::vector<gl::DrawCommand> commands;
  std::vector<DrawGroup> groups;
  std::uint64_t triangles = 0;
};

/// The draws for every slot that `keep` marks (one byte a slot); neighbouring clusters become one draw. Pure.
DrawList buildDrawList(const Scene& scene, const SceneView& view, const FrameGeometry& geometry, DrawUse use,
                       std::span<const std::uint8_t> keep);

} // namespace gnomon
