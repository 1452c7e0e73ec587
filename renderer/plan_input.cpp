#include "renderer/plan_input.h"

#include "renderer/core/light_direction.h"
#include "renderer/core/vec3.h"

namespace gnomon {

PlanInput planInput(const ResolvedFrame& frame, const SceneView& scene, const ReceiverDepths& receivers,
                    int maxTextureSize) {
  PlanInput input;
  input.view = frame.view;
  input.receivers = receivers;
  input.sceneBounds = scene.bounds;
  input.anchor = anchorOf(scene);
  input.atlas = frame.spec.atlas;
  input.maxTextureSize = maxTextureSize;
  input.frameWidth = frame.spec.width;
  input.frameHeight = frame.spec.height;
  const bool firstOnly = frame.spec.shadowLightPolicy == ShadowLightPolicy::first;
  for (std::size_t i = 0; i < frame.spec.lights->size(); ++i) {
    const Light& light = (*frame.spec.lights)[i];
    if (firstOnly && light.type != LightType::directional) continue;
    if (!light.shadow->enabled || light.intensity <= 0) {
      if (firstOnly) break; // the first is the first, with a shadow or without
      continue;
    }
    ShadowCaster caster{static_cast<int>(i), directionOf(light), *light.shadow, light.type};
    if (light.position) caster.position = toVector(*light.position) - frame.view.eye;
    caster.range = light.range.value_or(0.0);
    caster.outerCone = glm::radians(light.outerConeDegrees);
    caster.casts = (light.cullingMask & frame.layers.casting) != 0;
    caster.shadows = (light.cullingMask & frame.layers.receiving) != 0;
    input.casters.push_back(caster);
    if (firstOnly) break;
  }
  return input;
}

} // namespace gnomon
