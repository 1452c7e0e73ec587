#pragma once

#include <optional>

#include "renderer/device/device.h"
#include "renderer/gl/timer.h"
#include "renderer/passes/gpu_environments.h"
#include "renderer/passes/gpu_scene.h"
#include "renderer/passes/pass_inputs.h"
#include "renderer/passes/views/draw_views.h"

namespace gnomon {

/// What the frames of one context share.
struct GlShared {
  ProgramCache programs;
  GpuSceneCache scenes;
  TileCache tiles;
  GpuLightMaps lightMaps{};
  GpuEnvironments environments{};
};

/// A frame, drawn by OpenGL: one pass after the other, each keeping what the later ones read.
class GlFrame : public FrameDrawing {
 public:
  GlFrame(GlShared& shared, const FrameWork& work);

  Result<SeenDepths> survey() override;
  Status cast(const ShowInput& input, TileUse tiles) override;
  Status show(const ShowInput& input) override;
  Result<std::vector<PlacedTriangle>> shownTriangles() override;
  Result<std::vector<MapFootprint>> footprints(const ShowInput& input) override;
  Result<std::vector<float>> probe(const ShowInput& input, std::span<const ProbePoint> points) override;
  Image picture(std::size_t index) override;
  void endStage(std::string name) override;
  Result<FrameFacts> finish() override;

 private:
  Shading shadingOf(const ShowInput& input, const LightBuffers& buffers) const;
  BakedShading bakedShading();

  GlShared& shared_;
  const FrameWork work_;
  gl::StageClock clock_;
  bool draws_ = false; ///< the device may still be at what this stage gave it
  const GpuScene& gpu_;
  FrameGeometry geometry_;
  gl::Buffer instances_;
  SceneVertices vertices_;
  SceneVertices anchored_;
  shared::FrameData data_;
  gl::Buffer frame_;
  PassInputs inputs_;
  Survey survey_;
  ShadowAtlas atlas_;
  DrawnViews drawn_;
  std::optional<ShowInput> shown_;
};

} // namespace gnomon
