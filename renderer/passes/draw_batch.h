#pragma once

#include "renderer/gl/buffer.h"
#include "renderer/gl/vertex_array.h"
#include "renderer/passes/draw_list.h"
#include "renderer/passes/gpu_scene.h"

namespace gnomon {

/// A draw list on the device, with the vertex array that feeds it.
struct DrawBatch {
  gl::Buffer commands;
  gl::Buffer draws;
  gl::VertexArray vertices;
  std::vector<DrawGroup> groups;
  std::uint64_t triangles = 0;
  std::size_t drawCalls = 0;
};

DrawBatch uploadDraws(const DrawList& list, const GpuScene& scene);

/// Draws one group with a program whose state has been applied. The material's textures must have been bound.
void drawGroup(const DrawBatch& batch, const DrawGroup& group, const gl::Program& program);

/// Binds the textures that a material has to their units.
void bindMaterial(const GpuScene& scene, int material);

} // namespace gnomon
