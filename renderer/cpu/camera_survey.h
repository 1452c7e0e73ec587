#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "renderer/cpu/raster/raster.h"
#include "renderer/cpu/surface/textures.h"
#include "renderer/scene/mask_coverage.h"
#include "renderer/shadow/shadow_plan.h"

namespace gnomon::cpu {

/// What the camera sees.
struct Survey {
  SeenDepths seen;
  std::vector<std::uint8_t> visible; ///< one a slot of the geometry: not surely hidden behind others
  DepthBuffer buffer;                ///< numbered
  std::uint64_t triangles = 0;       ///< drawn
};

/// How a frame's camera is rastered. All of it outlives the calls.
struct CameraRaster {
  const FrameScene& scene;
  const CameraView& camera;
  std::span<const NodeSwitches> nodes; ///< one a node of the file; empty = every node has the defaults
  const Textures& textures;
  const MaskCoverages& masks; ///< one a material
  Holes* coverage = nullptr;  ///< asked instead of the materials where they have holes
  RasterScratch& scratch;
};

/// Rasters everything in view that is not surely hidden. Of many triangles the nearest are rastered first, so that what
/// they hide need not be. `samples`: 1 or 4 a pixel; `storage`: a buffer that nothing needs any more, whose memory is
/// used. `parts`: as FrameWork's.
Survey surveyScene(const CameraRaster& raster, int samples, std::span<const std::uint32_t> parts = {},
                   DepthBuffer storage = {});

/// The same surfaces at another number of samples; adds the triangles drawn.
DepthBuffer rasterVisible(const CameraRaster& raster, const Survey& survey, int samples, std::uint64_t& triangles);

/// Rasters the slots that `keep` marks (a byte each) over what is there; adds the triangles drawn.
void rasterOver(const CameraRaster& raster, std::span<const std::uint8_t> keep, DepthBuffer& buffer,
                std::uint64_t& triangles);

/// The slots that `keep` marks (a byte each), in the order in which every device draws them.
std::vector<RasterDraw> rasterDraws(const FrameScene& scene, DrawUse use, std::span<const std::uint8_t> keep);

/// One an instance: from its own space to the clip space that `clipFromRelative`, from the eye, leads to.
std::vector<glm::mat4> clipFromLocal(const FrameScene& scene, const glm::dmat4& clipFromRelative);

} // namespace gnomon::cpu
