#pragma once

#include <chrono>
#include <cstddef>
#include <future>
#include <map>
#include <optional>

#include "renderer/cpu/camera_survey.h"
#include "renderer/cpu/cast_tiles.h"
#include "renderer/cpu/picture_layers.h"
#include "renderer/cpu/scene_cache.h"
#include "renderer/cpu/show/show_view.h"
#include "renderer/cpu/sky_layer.h"
#include "renderer/device/device.h"

namespace gnomon::cpu {

/// What the frames of one device share.
struct Shared {
  SceneCache scenes;
  TileStore tiles;
  RasterScratch scratch;
  std::map<int, DepthBuffer> storage; ///< of earlier frames' surfaces, by samples a pixel: memory to be used again
  std::size_t mostStorage = 0;        ///< bytes of one of them; larger ones are let go
};

/// What view casterIds is made from besides: ShowJob's casters and nodes.
struct ShownCasters {
  std::vector<DepthBuffer> numbered; ///< what maps point to
  std::vector<TileMap> maps;
  std::vector<std::int32_t> slotNodes;
};

/// A frame, drawn by the processor: one stage after the other, each keeping what the later ones read.
class CpuFrame : public FrameDrawing {
 public:
  CpuFrame(Shared& shared, const FrameWork& work);
  ~CpuFrame() override;

  Result<SeenDepths> survey() override;
  Status cast(const ShowInput& input, TileUse tiles) override;
  Status show(const ShowInput& input) override;
  Result<std::vector<PlacedTriangle>> shownTriangles() override;
  Result<std::vector<MapFootprint>> footprints(const ShowInput& input) override;
  Result<std::vector<float>> probe(const ShowInput& input, std::span<const ProbePoint> points) override;
  Image picture(std::size_t index) override;
  Image takePicture(std::size_t index) override;
  void endStage(std::string name) override;
  Result<FrameFacts> finish() override;

 private:
  CameraRaster camera() const;
  CastInput castInput(const ShadowPlan& plan) const;
  DepthBuffer& surfaces(int samples);
  Status needHoles(); ///< textures that say where surfaces have holes
  /// Of all that may be seen, where some of them were never read; none else: kernels make levels that they lack.
  const std::vector<ReadTexture>& missingTextures(int samples);
  Status needLayers(int samples);
  Status needSky(int samples);
  const VolumeLayers* needVolumes(const ViewRequest& request); ///< null where the view knows none
  int samplesOf(const ViewRequest& request) const;             ///< a pixel
  std::vector<TexelMarks> readBy(const ShowInput& input);
  void makeTexels(const ShadowPlan& plan, std::span<const TexelMarks> read);
  void add(Image picture);
  Status showOne(const ShowInput& input, const ViewRequest& request);
  ShowJob jobOf(const ShowInput& input, const DepthBuffer& shown, const ShadowMaps& maps) const;
  ShownCasters shownCasters(const ShowInput& input) const;
  void endPass(const char* name, std::uint64_t triangles);

  Shared& shared_;
  const FrameWork work_;
  CachedScene& cached_;
  const SceneView& view_;
  FrameGeometry geometry_;
  FrameScene scene_;
  MaskCoverages masks_; ///< once there are holes: needHoles
  Survey survey_;
  CastTiles cast_;
  std::map<int, DepthBuffer> otherSurfaces_;        ///< by samples a pixel, where they aren't the survey's
  std::map<int, std::vector<ReadTexture>> missing_; ///< by samples a pixel
  bool surveyShown_ = false;                        ///< its surfaces are those of a view
  std::future<void> decoding_;                      ///< of the textures, while shadows are made
  std::map<int, ExactLayers> layers_;               ///< by samples a pixel
  std::map<int, SkyShadow> skies_;                  ///< by samples a pixel
  std::map<int, VolumeLayers> volumes_;             ///< by samples a pixel
  std::vector<Image> pictures_;
  FrameFacts facts_;
  std::chrono::steady_clock::time_point stageStart_, passStart_;
};

} // namespace gnomon::cpu
