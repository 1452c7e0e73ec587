#pragma once

#include "renderer/device/shader_data.h"
#include "renderer/gl/buffer.h"
#include "renderer/gl/draw.h"
#include "renderer/gl/pipeline_state.h"
#include "renderer/passes/gpu_light_maps.h"
#include "renderer/passes/gpu_scene.h"
#include "renderer/prepare/draw_list.h"

namespace gnomon {

/// Feeds a scene's vertices and its instances (shared::InstanceData) to every pass of a frame. Both outlive it.
struct SceneVertices {
  gl::VertexArray all;       ///< every attribute
  gl::VertexArray positions; ///< positions only, over welded indices: fewer vertices to run over
};

SceneVertices sceneVertices(const GpuScene& scene, const gl::Buffer& instances);

/// The same of what light maps are looked up by, without what reads positions only.
SceneVertices mappedVertices(const GpuMappedScene& scene, const gl::Buffer& instances);

/// Makes a draw list of the scene, whose ranges name its instances, one of a GpuMappedScene with that layout.
void drawMapped(const Scene& scene, const SceneView& view, const LightMapLayout& layout, DrawList& list);

/// Ranges that are drawn by one call, which can't be stopped.
struct DrawRun {
  std::size_t first = 0;
  std::size_t count = 0;
  std::size_t triangles = 0;
};

/// All of `ranges`, in runs of no more triangles than that, or of a single range.
std::vector<DrawRun> runsOf(std::span<const DrawRange> ranges, std::size_t triangles);

/// That devices are given at a time, where a frame may be stopped in between.
inline constexpr std::size_t kStepTriangles = 1 << 15;

/// Of a group, as much as is drawn by one call.
struct DrawPiece {
  DrawGroup group;
  std::size_t triangles = 0;
};

/// A draw list on the device.
struct DrawBatch {
  gl::Buffer ranges;
  std::vector<DrawPiece> pieces;
  std::uint64_t triangles = 0;
  std::size_t drawCalls = 0;
};

DrawBatch uploadDraws(const DrawList& list);

/// Instances that know the number of their draw's first triangle (prepare/draw_list.h): a copy for each range of
/// `list`, which names that copy from now on.
gl::Buffer numberedInstances(const FrameGeometry& geometry, DrawList& list);

/// Draws one group with a program whose state has been applied.
void drawGroup(const DrawBatch& batch, const DrawGroup& group, const SceneVertices& vertices,
               const gl::Program& program);

/// The state that a group adds to its pass's.
void applyFacing(Facing facing, gl::PipelineState& state);

/// Binds the textures that a material has to their units, and sets which material the program draws.
void bindMaterial(const GpuScene& scene, int material, const gl::Program& program);

} // namespace gnomon
