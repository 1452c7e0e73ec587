#pragma once

#include <span>
#include <vector>

#include "renderer/cpu/cast_tiles.h"
#include "renderer/cpu/shadow/shadow_maps.h"
#include "renderer/device/device.h"

namespace gnomon::cpu {

/// The lights and tiles of a frame as kernels read them. Refers to the tiles.
class ShownLights {
 public:
  ShownLights(const ShadowPlan& plan, std::span<const LitLight> lights, const CastTiles& cast);

  ShadowMaps maps(std::span<const Layer> layers) const { return {lights_, tiles_, maps_, atlas_, layers}; }

 private:
  std::vector<shared::LightData> lights_;
  std::vector<shared::TileData> tiles_;
  std::vector<TileMap> maps_;
  glm::vec2 atlas_;
};

} // namespace gnomon::cpu
