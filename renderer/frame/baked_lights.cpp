#include "renderer/frame/baked_lights.h"

#include "protocol/bake/bake_json.h"
#include "renderer/core/collect.h"
#include "renderer/resolve/check_frame.h"
#include "renderer/resolve/plan_input.h"

namespace gnomon {
namespace {

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
                                                      const SettledFrame& settled, const FrameSpec& asked,
                                                      const BakeProgress& progress) {
  std::vector<LightMapCache::Found> found;
  const ResolvedFrame& frame = settled.frame;
  for (const int light : settled.layered) {
    if (!techniqueOf(frame, light).baked) continue;
    const auto rays = traced.get(settled.scene, frame.scene);
    if (!rays) return rays.problems();
    const Progress ofLight = progress ? Progress([&](double share) { return progress(light, share); }) : Progress();
    const std::string key = maps.hasStore() ? keyInStore(*settled.loaded, frame, light) : std::string();
    auto made = maps.get({settled.scene, frame.scene, **rays, *frame.spec.lights, frame.nodes, key}, light, ofLight);
    if (!made) {
      if (made.problems().front().code == ProblemCode::unavailable) return made.problems();
      return placedAt(shadowPlace(asked, light) + "/lightMap", made.problems());
    }
    found.resize(frame.spec.lights->size());
    found[static_cast<std::size_t>(light)] = *std::move(made);
  }
  return found;
}

} // namespace gnomon
