#pragma once

#include <span>
#include <vector>

#include "renderer/cpu/frame_scene.h"
#include "renderer/cpu/shadow/shadow_maps.h"
#include "renderer/device/device.h"

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

} // namespace gnomon::cpu
