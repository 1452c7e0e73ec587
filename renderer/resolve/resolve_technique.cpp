#include "renderer/resolve/resolve_technique.h"

#include <algorithm>

#include "protocol/base/result.h"
#include "protocol/spec/technique_traits.h"
#include "renderer/resolve/plan_input.h"

namespace gnomon {
namespace {

std::string told(const std::string& name, int index) {
  return name.empty() ? std::to_string(index) : "\"" + name + "\"";
}

/// Where the technique of a light was asked for.
std::string pointerOf(const FrameSpec& asked, std::size_t light) {
  const bool own = asked.lights && (*asked.lights)[light].shadow;
  return own ? "/lights/" + std::to_string(light) + "/shadow/technique" : "/shadow/technique";
}

/// The first caster of a light that has holes; null = there is none.
const Instance* firstWithHoles(const Scene& scene, const ResolvedFrame& frame, const Light& light) {
  const std::vector<Instance>& instances = scene.scenes[static_cast<std::size_t>(frame.scene)].instances;
  const auto found = std::find_if(instances.begin(), instances.end(), [&](const Instance& instance) {
    const NodeSwitches node =
        frame.nodes.empty() ? NodeSwitches{} : frame.nodes[static_cast<std::size_t>(instance.node)];
    return castsFrom(light, node) &&
           scene.materials[static_cast<std::size_t>(materialOf(scene, instance))].alphaMode != AlphaMode::opaque;
  });
  return found == instances.end() ? nullptr : &*found;
}

} // namespace

Status checkTechniques(const FrameSpec& asked, const Scene& scene, const ResolvedFrame& frame) {
  ProblemList problems;
  std::string last;
  for (const int index : shadowingLights(frame)) {
    const auto light = static_cast<std::size_t>(index);
    const Light& settled = (*frame.spec.lights)[light];
    const std::string pointer = pointerOf(asked, light);
    if (!traitsOf(settled.shadow->technique).needsOpaqueCasters || pointer == last) continue;
    const Instance* instance = firstWithHoles(scene, frame, settled);
    if (instance == nullptr) continue;
    const int material = materialOf(scene, *instance);
    problems.add({ProblemCode::unsupportedFeature, pointer,
                  "Technique " + std::string(spell(settled.shadow->technique)) + " does not support alpha: node " +
                      told(scene.nodes[static_cast<std::size_t>(instance->node)].name, instance->node) +
                      " casts, and its material " +
                      told(scene.materials[static_cast<std::size_t>(material)].name, material) +
                      " is masked, blended or lets light through.",
                  "opaque casters: turn the node's castShadow off, or choose another technique",
                  std::string(spell(settled.shadow->technique))});
    last = pointer;
  }
  if (problems.empty()) return Done{};
  return std::move(problems).take();
}

} // namespace gnomon
