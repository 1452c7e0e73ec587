#include "renderer/resolve/choose_techniques.h"

#include <algorithm>

#include "renderer/resolve/plan_input.h"

namespace gnomon {
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
  const std::vector<int> layered = layeredLights(frame);
  auto used = static_cast<std::size_t>(
      std::count_if(layered.begin(), layered.end(), [&](int light) { return !techniqueOf(frame, light).baked; }));
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

} // namespace gnomon
