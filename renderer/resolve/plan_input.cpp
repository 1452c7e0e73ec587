#include "renderer/resolve/plan_input.h"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "protocol/spec/frame_lights.h"
#include "renderer/core/light.h"
#include "renderer/core/linear_algebra.h"

namespace gnomon {

std::vector<int> shadowingLights(const ResolvedFrame& frame) {
  return shadowingLights(*frame.spec.lights, frame.spec.shadowLightPolicy);
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

std::vector<int> lightsToBake(const ResolvedFrame& frame) {
  std::vector<int> lights = layeredLights(frame);
  std::erase_if(lights, [&](int light) { return !techniqueOf(frame, light).baked; });
  return lights;
}

std::vector<int> mappedLights(const ResolvedFrame& frame) {
  return mappedLights(*frame.spec.lights, frame.spec);
}

bool needsEdges(const ResolvedFrame& frame) {
  const auto& lights = *frame.spec.lights;
  return std::any_of(lights.begin(), lights.end(),
                     [](const Light& light) { return traitsOf(light.shadow->technique).needsEdges; });
}

SceneCounts shadowCounts(const Scene& scene, const SceneView& view) {
  SceneCounts counts{.triangles = view.triangles};
  for (const Instance& instance : view.instances) {
    if (stopsAllLight(scene.materials[static_cast<std::size_t>(materialOf(scene, instance))])) continue;
    counts.holed += scene.primitives[static_cast<std::size_t>(instance.primitive)].indexCount / 3;
  }
  return counts;
}

void chooseTechniques(const Scene& scene, DeviceKind device, std::size_t layers, ResolvedFrame& frame) {
  std::vector<Light>& lights = *frame.spec.lights;
  const auto isOpen = [](const Light& light) { return light.shadow->technique == ShadowTechnique::auto_; };
  if (std::none_of(lights.begin(), lights.end(), isOpen)) return;
  const SceneCounts counts = shadowCounts(scene, scene.scenes[static_cast<std::size_t>(frame.scene)]);
  std::size_t used = layeredLights(frame).size() - lightsToBake(frame).size();
  frame.choices.resize(lights.size());
  for (const int index : shadowingLights(frame)) {
    Light& light = lights[static_cast<std::size_t>(index)];
    if (!isOpen(light)) continue;
    TechniqueChoice choice = chooseTechnique(light, frame.spec, counts, device);
    if (choice.technique == ShadowTechnique::rayTraced && used >= layers) {
      choice.technique = ShadowTechnique::shadowMap;
      choice.why = "Rays for so many lights would take more memory than a frame may have.";
    }
    used += choice.technique == ShadowTechnique::rayTraced ? 1 : 0;
    light.shadow->technique = choice.technique;
    frame.choices[static_cast<std::size_t>(index)] = std::move(choice);
  }
  // No shadow is looked for: the word in the effective spec is that of the cheapest.
  for (Light& light : lights) {
    if (isOpen(light)) light.shadow->technique = ShadowTechnique::shadowMap;
  }
}

namespace {

constexpr std::uint32_t kAllGroups = ~0u;

std::uint32_t receivingGroups(const ResolvedFrame& frame, int light) {
  return frame.groups.ofLight[static_cast<std::size_t>(light)].shadowed;
}

/// What casts or receives shadows of lights, by their layers and the groups that receive. The scene's where that is
/// all.
class TakingPart {
 public:
  TakingPart(const ResolvedFrame& frame, const SceneView& view) : frame_(frame), view_(view) {}

  const Aabb& in(int light) {
    const Light& of = (*frame_.spec.lights)[static_cast<std::size_t>(light)];
    const std::uint32_t receiving = receivingGroups(frame_, light);
    const auto [found, isNew] = bounds_.try_emplace({of.cullingMask, receiving});
    if (!isNew) return found->second;
    for (std::size_t i = 0; i < view_.instances.size(); ++i) {
      const Instance& instance = view_.instances[i];
      const NodeSwitches node = switchesOf(frame_.nodes, instance.node);
      const std::uint32_t group = frame_.groups.ofInstance.empty() ? 0u : frame_.groups.ofInstance[i];
      const bool receives = node.visible && (receiving >> group & 1u) != 0;
      if (receives || castsFrom(of, node)) found->second.add(instance.bounds);
    }
    return found->second;
  }

 private:
  const ResolvedFrame& frame_;
  const SceneView& view_;
  std::map<std::pair<int, std::uint32_t>, Aabb> bounds_;
};

/// The lights whose maps are planned: mappedLights, and those for which technique auto chose rays.
std::vector<int> plannedLights(const ResolvedFrame& frame) {
  std::vector<int> planned = mappedLights(frame);
  for (std::size_t i = 0; i < frame.choices.size(); ++i) {
    const int light = static_cast<int>(i);
    if (frame.choices[i] && !std::binary_search(planned.begin(), planned.end(), light)) planned.push_back(light);
  }
  std::sort(planned.begin(), planned.end());
  return planned;
}

PlanInput planInput(const ResolvedFrame& frame, const SceneView& scene, SeenDepths seen, int maxTextureSize) {
  PlanInput input;
  input.view = frame.view;
  input.receivers = std::move(seen.all);
  input.parts = std::move(seen.parts);
  input.sceneBounds = scene.bounds;
  input.anchor = anchorOf(scene);
  input.atlas = frame.spec.atlas;
  input.maxTextureSize = maxTextureSize;
  input.frameWidth = frame.spec.width;
  input.frameHeight = frame.spec.height;
  const std::vector<std::uint32_t> parts = receiverParts(frame);
  TakingPart takingPart(frame, scene);
  for (const int index : plannedLights(frame)) {
    const Light& light = (*frame.spec.lights)[static_cast<std::size_t>(index)];
    ShadowCaster caster{index, directionOf(light), *light.shadow, light.type};
    if (light.position) caster.position = toVector(*light.position) - frame.view.eye;
    caster.range = light.range.value_or(0.0);
    caster.lightRadius = radiusOf(light);
    caster.outerCone = glm::radians(light.outerConeDegrees);
    caster.casts = (light.cullingMask & frame.layers.casting) != 0;
    caster.shadows = (light.cullingMask & frame.layers.receiving) != 0;
    if (const std::uint32_t groups = receivingGroups(frame, index); groups != kAllGroups) {
      caster.part = static_cast<int>(std::find(parts.begin(), parts.end(), groups) - parts.begin());
    }
    if (!frame.nodes.empty() || caster.part >= 0) caster.bounds = takingPart.in(index);
    input.casters.push_back(caster);
  }
  return input;
}

} // namespace

std::vector<std::uint32_t> receiverParts(const ResolvedFrame& frame) {
  std::vector<std::uint32_t> parts;
  for (const int light : plannedLights(frame)) {
    const std::uint32_t groups = receivingGroups(frame, light);
    if (groups != kAllGroups && std::find(parts.begin(), parts.end(), groups) == parts.end()) parts.push_back(groups);
  }
  return parts;
}

FramePlans framePlans(const ResolvedFrame& frame, const SceneView& scene, SeenDepths seen, int maxTextureSize) {
  FramePlans plans{planInput(frame, scene, std::move(seen), maxTextureSize), {}, {}, {}};
  const std::vector<int> mapped = mappedLights(frame);
  if (mapped.size() < plans.input.casters.size()) {
    plans.wholeInput = plans.input;
    plans.whole = planShadows(plans.wholeInput);
    std::erase_if(plans.input.casters, [&](const ShadowCaster& caster) {
      return !std::binary_search(mapped.begin(), mapped.end(), caster.light);
    });
  }
  plans.drawn = planShadows(plans.input);
  return plans;
}

} // namespace gnomon
