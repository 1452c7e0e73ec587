#pragma once

#include "renderer/evaluation/evaluate.h"
#include "renderer/frame/gpu_scene_cache.h"
#include "renderer/frame/traced_scene_cache.h"
#include "renderer/passes/program_cache.h"
#include "renderer/passes/tiles/tile_cache.h"

namespace gnomon {

/// What drawing a frame takes besides the frame.
struct DrawingTools {
  GpuSceneCache& scenes;
  ProgramCache& programs;
  TileCache& tiles;
  TracedSceneCache& traced;
  const RendererInfo& device;
};

/// As Renderer::shimmer.
Result<Shimmer> measureShimmer(const DrawingTools& tools, const ScenePtr& scene, const FrameSpec& spec,
                               std::span<const Camera> path, const Progress& progress);

} // namespace gnomon
