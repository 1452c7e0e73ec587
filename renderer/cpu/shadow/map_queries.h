#pragma once

#include <span>
#include <vector>

#include "renderer/cpu/frame_scene.h"
#include "renderer/cpu/shadow/shadow_maps.h"
#include "renderer/device/device.h"
#include "renderer/prepare/outlines.h"
#include "renderer/techniques/traced_shadow.h"

namespace gnomon::cpu {

/// What the pixels of a picture are asked of one light, which has tiles. All of it outlives the call.
struct MapQuery {
  const FrameScene& scene;
  const DepthBuffer& surfaces; ///< numbered
  const ShadowMaps& maps;
  int light = 0; ///< index into maps.lights
};

/// FrameDrawing::footprints, on all cores. Of surfaces with one sample a pixel.
std::vector<MapFootprint> mapFootprints(const MapQuery& query);

/// What the light's map, of one sample a texel, knows of each pixel: row by row from the BOTTOM, on all cores. Where a
/// pixel's samples show several triangles it knows nothing. `outlines`: of each of the light's tiles.
std::vector<Verdict> mapVerdicts(const MapQuery& query, std::span<const TileOutlines> outlines);

} // namespace gnomon::cpu
