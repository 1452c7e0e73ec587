#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "renderer/bake/baked_light.h"
#include "renderer/scene/node_switches.h"
#include "renderer/scene/scene.h"

namespace gnomon {

/// A light with its shadow on a scene.
struct ShadowedLight {
  const Light& light; ///< effective
  const BakedLight& baked;
};

/// What arrives on the side of the surfaces that their normals point to; on either side where the material is
/// double-sided. Linear RGB in the unit of the lights, texel by texel as the layout has them.
struct IrradianceMap {
  int width = 0;
  int height = 0;
  std::vector<glm::vec3> texels;
};

/// REQUIRES: at least one light, and all baked on one layout.
IrradianceMap irradianceMap(const Scene& scene, const SceneView& view, std::span<const NodeSwitches> nodes,
                            std::span<const ShadowedLight> lights);

} // namespace gnomon
