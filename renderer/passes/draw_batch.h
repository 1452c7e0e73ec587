#pragma once

#include "renderer/gl/buffer.h"
#include "renderer/gl/draw.h"
#include "renderer/passes/draw_list.h"
#include "renderer/passes/gpu_scene.h"

namespace gnomon {

/// Feeds a scene's vertices and its instances (shared::InstanceData) to every pass of a frame. Both outlive it.
struct SceneVertices {
  gl::VertexArray all;       ///< every attribute
  gl::VertexArray positions; ///< positions only, over welded indices: fewer vertices to run over
};

SceneVertices sceneVertices(const GpuScene& scene, const gl::Buffer& instances);

/// A draw list on the device.
struct DrawBatch {
  gl::Buffer commands;
  std::vector<DrawGroup> groups;
  std::uint64_t triangles = 0;
  std::size_t drawCalls = 0;
};

DrawBatch uploadDraws(const DrawList& list);

/// Draws one group with a program whose state has been applied.
void drawGroup(const DrawBatch& batch, const DrawGroup& group, const SceneVertices& vertices,
               const gl::Program& program);

/// Binds the textures that a material has to their units, and tells the program which material it is.
void bindMaterial(const GpuScene& scene, int material, const gl::Program& program);

} // namespace gnomon
