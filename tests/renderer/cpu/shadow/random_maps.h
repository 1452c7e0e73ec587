#pragma once

#include <random>
#include <string>
#include <vector>

#include "renderer/cpu/shadow/shadow_maps.h"
#include "tests/renderer/cpu/shadow/shadow_kernels.h"

namespace gnomon::cpu {

struct MapsOptions {
  int lightType = GNOMON_DIRECTIONAL;
  int filterKind = GNOMON_FILTER_KERNEL;
  int filterSize = 1;
  int samples = 1;
  bool manualBias = false;
  bool fadesOut = false;
};

/// A light with tiles full of random depths, and what ShadowMaps refers to.
struct RandomMaps {
  std::vector<shared::LightData> lights;
  std::vector<shared::TileData> tiles;
  std::vector<DepthBuffer> depths;
  std::vector<std::vector<glm::vec4>> moments;
  std::vector<TileMap> maps;

  ShadowMaps view() const;
};

inline constexpr int kTestAtlas = 1024;
/// That kernels are compared at.
inline constexpr int kPoints = 100'000;

RandomMaps randomMaps(std::mt19937& random, const MapsOptions& options);

/// Points in and around what the tiles cover; their surfaces face every way, some along the light.
std::vector<AskedPoint> randomPoints(std::mt19937& random, const RandomMaps& maps, int count);

float between(std::mt19937& random, float low, float high);
glm::vec3 randomDirection(std::mt19937& random);

} // namespace gnomon::cpu
