#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "protocol/base/result.h"
#include "renderer/core/camera_view.h"
#include "renderer/gl/buffer.h"
#include "renderer/gl/pipeline_state.h"
#include "renderer/gl/program.h"
#include "renderer/passes/draw_batch.h"
#include "renderer/passes/gpu_scene.h"
#include "renderer/passes/stencil/stencil_outlines.h"
#include "renderer/prepare/cluster_choice.h"
#include "renderer/prepare/frame_geometry.h"
#include "renderer/scene/node_switches.h"

namespace gnomon {

/// Shader programs by their source, made when a scene first asks for them.
class ProgramCache {
 public:
  /// The program; valid as long as the cache. A backend problem where the driver refuses it.
  Result<const gl::Program*> get(const gl::ProgramSource& source);

 private:
  std::map<std::string, gl::Program> programs_;
};

/// A texture as large as `from`, of one value a texel that a fragment shader makes of all samples there.
Result<gl::Texture> drawTexture(ProgramCache& programs, const std::string& shader, const gl::Texture& from, GLuint unit,
                                GLenum format);

/// What every pass of a frame reads. All of it outlives the frame.
struct PassInputs {
  const Scene& scene;
  const SceneView& view;
  const GpuScene& gpu;
  const FrameGeometry& geometry;
  const CameraView& camera;
  const gl::Buffer& frame;       ///< shared::FrameData
  const gl::Buffer& instances;   ///< shared::InstanceData of geometry's instances
  const SceneVertices& vertices; ///< of the scene and of geometry's instances
  const SceneVertices& anchored; ///< the same, its instances relative to anchorOf(view) instead of the eye
  ProgramCache& programs;
  int width = 0; ///< of the frame, pixels
  int height = 0;
  std::span<const NodeSwitches> nodes; ///< one a node of the file; empty = every node has the defaults
  std::span<const EdgeMesh> edges;     ///< one a primitive; empty where no light's technique asks for them
  bool receiverGroups = false;         ///< some light tells receiver groups apart: surfaces say to which they belong
  const gl::Texture* environment = nullptr; ///< its atlas; null = the studio
};

/// Binds the buffers that every pass reads.
void bindInputs(const PassInputs& inputs);

/// The program for a group, ready but for its material; `material` is null for a group of any opaque ones.
using GroupProgram = std::function<Result<const gl::Program*>(const DrawGroup& group, const Material* material)>;

/// Draws every group of a batch, its material bound, with the group's own facing and `state` for the rest.
Status drawGroups(const PassInputs& inputs, const SceneVertices& vertices, const DrawBatch& batch,
                  gl::PipelineState state, const GroupProgram& programOf);

DrawBatch uploadCasters(const PassInputs& inputs, const TileCasters& casters);

/// The program that draws casters: of a masked material, or (null) of any opaque one.
using CastProgram = std::function<gl::ProgramSource(const Material* masked)>;

/// Draws casters into a tile's rectangle of `framebuffer`; the nearest to the light stays.
Status drawTile(const PassInputs& inputs, const ShadowTile& tile, const DrawBatch& batch, GLuint framebuffer,
                const CastProgram& programOf);

} // namespace gnomon
