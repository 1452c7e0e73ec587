#include "renderer/resolve/plan_input.h"

#include <algorithm>
#include <vector>

#include "renderer/core/light.h"
#include "renderer/core/vec3.h"

namespace gnomon {

namespace {

/// A light that gives off nothing has no shadow to be seen.
bool shines(const Light& light) {
  return light.intensity > 0 && (light.temperatureKelvin || light.color.value_or(Vec3{1, 1, 1}) != Vec3{0, 0, 0});
}

} // namespace

std::vector<int> shadowingLights(const ResolvedFrame& frame) {
  std::vector<int> lights;
  const bool firstOnly = frame.spec.shadowLightPolicy == ShadowLightPolicy::first;
  for (std::size_t i = 0; i < frame.spec.lights->size(); ++i) {
    const Light& light = (*frame.spec.lights)[i];
    if (firstOnly && light.type != LightType::directional) continue;
    if (light.shadow->enabled && shines(light)) lights.push_back(static_cast<int>(i));
    if (firstOnly) break; // the first is the first, with a shadow or without
  }
  return lights;
}

const TechniqueTraits& techniqueOf(const ResolvedFrame& frame, int light) {
  return traitsOf((*frame.spec.lights)[static_cast<std::size_t>(light)].shadow->technique);
}

std::vector<int> layeredLights(const ResolvedFrame& frame) {
  std::vector<int> lights = shadowingLights(frame);
  std::erase_if(lights, [&](int light) { return !techniqueOf(frame, light).layered; });
  std::stable_partition(lights.begin(), lights.end(), [&](int light) { return !techniqueOf(frame, light).baked; });
  return lights;
}

std::vector<int> mappedLights(const ResolvedFrame& frame) {
  const auto& views = frame.spec.views;
  const bool shown = std::any_of(views.begin(), views.end(), [](View view) { return traitsOf(view).tiles; });
  std::vector<int> lights = shadowingLights(frame);
  std::erase_if(lights, [&](int light) {
    const TechniqueTraits& technique = techniqueOf(frame, light);
    return !technique.mapped || (technique.mapSparesRays() && !shown);
  });
  return lights;
}

bool needsEdges(const ResolvedFrame& frame, std::span<const int> mapped) {
  for (int light = 0; light < static_cast<int>(frame.spec.lights->size()); ++light) {
    const TechniqueTraits& technique = techniqueOf(frame, light);
    if (!technique.needsEdges) continue;
    if (!technique.mapped || std::find(mapped.begin(), mapped.end(), light) != mapped.end()) return true;
  }
  return false;
}

PlanInput planInput(const ResolvedFrame& frame, const SceneView& scene, const ReceiverDepths& receivers,
                    std::span<const int> mapped, int maxTextureSize) {
  PlanInput input;
  input.view = frame.view;
  input.receivers = receivers;
  input.sceneBounds = scene.bounds;
  input.anchor = anchorOf(scene);
  input.atlas = frame.spec.atlas;
  input.maxTextureSize = maxTextureSize;
  input.frameWidth = frame.spec.width;
  input.frameHeight = frame.spec.height;
  for (const int index : mapped) {
    const Light& light = (*frame.spec.lights)[static_cast<std::size_t>(index)];
    ShadowCaster caster{index, directionOf(light), *light.shadow, light.type};
    if (traitsOf(light.shadow->technique).mapSparesRays()) {
      // Rays draw the edges: what the map needs is the nearest tile, sharp.
      caster.shadow.filter = Filter{FilterType::hard};
      caster.shadow.bias = Bias{};
      caster.shadow.blendCascades = false;
    }
    if (light.position) caster.position = toVector(*light.position) - frame.view.eye;
    caster.range = light.range.value_or(0.0);
    caster.lightRadius = radiusOf(light);
    caster.outerCone = glm::radians(light.outerConeDegrees);
    caster.casts = (light.cullingMask & frame.layers.casting) != 0;
    caster.shadows = (light.cullingMask & frame.layers.receiving) != 0;
    input.casters.push_back(caster);
  }
  return input;
}

} // namespace gnomon
