#pragma once

#include "renderer/cpu/shadow/shadow_maps.h"
#include "tests/renderer/cpu/shadow/shadow_kernels.h"

/// What shaders/common_shadow*.glsl compute, a number at a time: their text with GLM's names.
namespace gnomon::cpu::truth {

struct Lookup {
  glm::vec3 coordinate{0};
  float divisor = 1;
  bool inside = false;
};

struct TileChoice {
  int first = 0;
  int second = 0;
  float blend = 0;
  float fade = 0;
  bool covered = false;
};

Lookup lookupIn(const shared::LightData& light, const shared::TileData& tile, const AskedPoint& receiver);
TileChoice chooseTile(const ShadowMaps& maps, int light, const AskedPoint& receiver);
float shadowVisibility(const ShadowMaps& maps, int light, const AskedPoint& receiver);

} // namespace gnomon::cpu::truth
