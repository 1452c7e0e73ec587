#include "renderer/prepare/lit_light.h"

#include "protocol/spec/traits.h"
#include "renderer/core/light.h"
#include "renderer/core/vec3.h"

namespace gnomon {
namespace {

glm::dvec3 colorOf(const Light& light) {
  if (light.temperatureKelvin) return blackBodyColor(*light.temperatureKelvin);
  return toVector(light.color.value_or(Vec3{1, 1, 1}));
}

std::optional<ManualBias> manualBias(const Bias& bias) {
  const auto offset = manualOffset(bias);
  if (!offset) return std::nullopt;
  return ManualBias{bias.depth.value_or(0.0), bias.slope.value_or(0.0), *offset};
}

LitLight litLight(const Light& light, const glm::dvec3& eye) {
  LitLight lit;
  lit.type = light.type;
  lit.direction = directionOf(light);
  if (light.position) {
    lit.position = toVector(*light.position) - eye;
    lit.range = light.range.value_or(0.0);
  }
  lit.radiance = colorOf(light) * light.intensity;
  lit.innerCone = glm::radians(light.innerConeDegrees);
  lit.outerCone = glm::radians(light.outerConeDegrees);
  return lit;
}

} // namespace

std::vector<LitLight> litLights(std::span<const Light> lights, const ShadowPlan& plan, const glm::dvec3& eye,
                                std::span<const LitGroups> groups, std::span<const int> layered) {
  std::vector<LitLight> lit;
  for (const Light& light : lights) {
    lit.push_back(litLight(light, eye));
    if (!groups.empty()) lit.back().groups = groups[lit.size() - 1];
  }
  for (const PlannedLight& planned : plan.lights) {
    const auto index = static_cast<std::size_t>(planned.light);
    const Shadow& shadow = *lights[index].shadow;
    LitLight& light = lit[index];
    light.firstTile = planned.firstTile;
    light.tileCount = planned.tileCount;
    light.filter = kernelOf(shadow.filter, radiusOf(lights[index]));
    light.manualBias = manualBias(shadow.bias);
    light.fadesOut = planned.fadeOut;
    light.smoothTerminator = shadow.terminator == Terminator::smooth;
    light.strength = shadow.strength;
    light.shadowColor = toVector(shadow.color);
  }
  for (std::size_t layer = 0; layer < layered.size(); ++layer) {
    const auto index = static_cast<std::size_t>(layered[layer]);
    lit[index].visibilityLayer = static_cast<int>(layer);
    const TechniqueTraits& technique = traitsOf(lights[index].shadow->technique);
    lit[index].layerOmitsTurnedFaces = !technique.traced || technique.baked;
    lit[index].strength = lights[index].shadow->strength;
    lit[index].shadowColor = toVector(lights[index].shadow->color);
  }
  return lit;
}

std::vector<LitLight> atFullStrength(std::vector<LitLight> lights) {
  for (LitLight& light : lights) light.strength = 1;
  return lights;
}

} // namespace gnomon
