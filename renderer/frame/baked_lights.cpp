#include "renderer/frame/baked_lights.h"

#include <algorithm>
#include <optional>
#include <span>

#include "protocol/bake/bake_json.h"
#include "protocol/spec/traits.h"
#include "renderer/resolve/plan_input.h"
#include "renderer/scene/animation/posed_scene.h"

namespace gnomon {
namespace {

std::string shadowPointer(const FrameSpec& asked, int light) {
  const bool own = asked.lights && (*asked.lights)[static_cast<std::size_t>(light)].shadow;
  return own ? "/lights/" + std::to_string(light) + "/shadow" : "/shadow";
}

std::span<const glm::vec3> verticesOf(const Scene& scene, const Instance& instance) {
  const Primitive& primitive = scene.primitives[static_cast<std::size_t>(instance.primitive)];
  return std::span(scene.positions).subspan(primitive.baseVertex, primitive.vertexCount);
}

/// A node that an animation moves away from where it stands without, hides, or whose mesh it deforms; -1 = there is
/// none.
int movedNode(const Scene& without, const Scene& with, int index) {
  const std::vector<Instance>& still = without.scenes[static_cast<std::size_t>(index)].instances;
  const std::vector<Instance>& moved = with.scenes[static_cast<std::size_t>(index)].instances;
  const bool deformed = without.positions != with.positions;
  const auto same = [&](const Instance& a, const Instance& b) {
    if (a.node != b.node || a.primitive != b.primitive || a.copy != b.copy) return false;
    if (a.worldFromLocal != b.worldFromLocal || a.bounds.min != b.bounds.min || a.bounds.max != b.bounds.max)
      return false;
    return !deformed || std::ranges::equal(verticesOf(without, a), verticesOf(with, b));
  };
  const auto [a, b] = std::mismatch(still.begin(), still.end(), moved.begin(), moved.end(), same);
  if (b != moved.end()) return b->node;
  return a == still.end() ? -1 : a->node;
}

std::string nameOf(const Scene& scene, int node) {
  const std::string& name = scene.nodes[static_cast<std::size_t>(node)].name;
  return name.empty() ? std::to_string(node) : "\"" + name + "\"";
}

/// Changes with all that the light's shadow depends on. Empty where the scene has no id.
std::string keyInStore(const Scene& scene, const ResolvedFrame& frame, int light) {
  const std::string& id = scene.summary.id;
  if (id.empty()) return {};
  FrameSpec spec = frame.spec;
  spec.lights = std::vector{shadowOf((*frame.spec.lights)[static_cast<std::size_t>(light)])};
  spec.shadow = Shadow{};
  return id + "-" + bakeKey(id, spec);
}

} // namespace

Result<std::vector<LightMapCache::Found>> bakedLights(LightMapCache& maps, TracedSceneCache& traced,
                                                      const FrameScene& scene, const FrameSpec& asked,
                                                      const ResolvedFrame& frame, const BakeProgress& progress) {
  std::vector<LightMapCache::Found> found;
  std::optional<int> moved;
  for (const int light : layeredLights(frame)) {
    const Shadow& shadow = *(*frame.spec.lights)[static_cast<std::size_t>(light)].shadow;
    if (!traitsOf(shadow.technique).baked) continue;
    const std::string pointer = shadowPointer(asked, light);
    if (!moved) {
      const auto still = posedScene(scene.loaded, {.nodes = frame.spec.nodes});
      if (!still) return still.problems();
      moved = movedNode(**still, *scene.posed, frame.scene);
    }
    if (const int node = *moved; node >= 0) {
      return Problem{ProblemCode::unsupportedFeature, pointer + "/technique",
                     "A light map holds the shadow of what stands still, but this pose moves node " +
                         nameOf(*scene.loaded, node) + ".",
                     "another technique, or no animation", "lightMap"};
    }
    const auto rays = traced.get(scene.posed, frame.scene);
    if (!rays) return rays.problems();
    const Progress ofLight = progress ? Progress([&](double share) { return progress(light, share); }) : Progress();
    const std::string key = maps.hasStore() ? keyInStore(*scene.loaded, frame, light) : std::string();
    auto made = maps.get({scene.posed, frame.scene, **rays, *frame.spec.lights, frame.nodes, key}, light, ofLight);
    if (!made) {
      if (made.problems().front().code == ProblemCode::unavailable) return made.problems();
      Problems problems = made.problems();
      for (Problem& problem : problems) problem.pointer = pointer + "/lightMap" + problem.pointer;
      return problems;
    }
    found.resize(frame.spec.lights->size());
    found[static_cast<std::size_t>(light)] = *std::move(made);
  }
  return found;
}

} // namespace gnomon
