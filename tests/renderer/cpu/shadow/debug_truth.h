#pragma once

#include <optional>

#include "renderer/device/device.h"
#include "tests/renderer/cpu/shadow/debug_kernels.h"

/// What shaders/common_debug.glsl and displacement.frag compute, a number at a time.
namespace gnomon::cpu::truth {

struct DebugTexel {
  int tile = 0; ///< among the light's
  float blend = 0;
  const shared::TileData& data;
  glm::vec3 coordinate{0};
  float divisor = 1;
};

std::optional<DebugTexel> debugTexel(const DebugMaps& debug, const AskedPoint& receiver);
float texelDensity(const DebugMaps& debug, const DebugTexel& texel, const AskedPoint& receiver);
float biasMetres(const DebugMaps& debug, const DebugTexel& texel, const AskedPoint& receiver);
int casterNode(const DebugMaps& debug, const AskedPoint& receiver);
glm::vec3 nodeColor(int node);
glm::vec3 texelGrid(const DebugMaps& debug, const glm::vec3& shown, const AskedPoint& receiver);
MapFootprint footprint(const DebugMaps& debug, const AskedPoint& receiver);

} // namespace gnomon::cpu::truth
