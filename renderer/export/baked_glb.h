#pragma once

#include <glm/glm.hpp>
#include <nlohmann/json.hpp>
#include <span>
#include <vector>

#include "protocol/base/bytes.h"
#include "protocol/base/result.h"
#include "renderer/bake/baked_light.h"
#include "renderer/environment/environment.h"
#include "renderer/image/image.h"
#include "renderer/scene/node_switches.h"
#include "renderer/scene/scene.h"

namespace gnomon {

/// A light with its shadow on a scene.
struct ShadowedLight {
  const Light& light; ///< effective
  const BakedLight& baked;
};

/// An environment with its shadow on a scene.
struct ShadowedEnvironment {
  const FrameEnvironment& environment;
  glm::dvec3 ambient{0}; ///< radiance of the studio, where that is the environment; linear RGB
  const BakedLight& baked;
};

/// The light on the front of surfaces, or on either side of double-sided ones: linear RGB in the unit of the lights,
/// texel by texel of the layout.
struct IrradianceMap {
  int width = 0;
  int height = 0;
  std::vector<glm::vec3> texels;
};

/// `environment`: null = none. REQUIRES: it or at least one light, and all baked on one layout.
IrradianceMap irradianceMap(const Scene& scene, const SceneView& view, std::span<const NodeSwitches> nodes,
                            std::span<const ShadowedLight> lights, const ShadowedEnvironment* environment = nullptr);

/// A GLB that grows: its JSON, and the bytes of its one buffer.
struct GlbDraft {
  nlohmann::json json;
  Bytes binary;

  /// The index of a new buffer view over these bytes, which begin at a multiple of four.
  std::size_t addView(std::span<const std::uint8_t> bytes);

  /// The index of a new image, a PNG.
  std::size_t addPng(std::span<const std::uint8_t> png);
};

/// Adds every material that `used` marks, with its textures, and the map to those that show light; returns the index of
/// each, -1 = not used. `map`: its texture; `intensity`: its scale. The second set of coordinates becomes TEXCOORD_2. A
/// problem where a picture of the scene is broken.
Result<std::vector<int>> addMaterials(const Scene& scene, const std::vector<std::uint8_t>& used, std::size_t map,
                                      float intensity, GlbDraft& draft);

/// Whether a texture of the material reads this set of coordinates.
bool readsUv(const Material& material, int set);

/// The posed scene as GLB: each visible placed primitive in a mesh of its own with TEXCOORD_1 for the map (8-bit sRGB
/// under MOZ_lightmap), shared materials, perspective cameras. A problem where a picture is broken; tooLarge above
/// `mostBytes`.
Result<Bytes> bakedGlb(const Scene& scene, const SceneView& view, std::span<const NodeSwitches> nodes,
                       const LightMapLayout& layout, const IrradianceMap& map, std::size_t mostBytes);

} // namespace gnomon
