#include "renderer/frame/baked_scene.h"

#include <algorithm>
#include <chrono>

#include "protocol/bake/bake.h"
#include "protocol/base/elapsed.h"
#include "renderer/core/collect.h"
#include "renderer/frame/make_report.h"
#include "renderer/frame/render_frame.h"
#include "renderer/frame/settle_frame.h"
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
  spec.environment = {}; // its sun is that light, if it is
  return id + "-" + bakeKey(id, spec);
}

} // namespace

Result<std::vector<LightMapCache::Found>> bakedLights(LightMapCache& maps, TracedSceneCache& traced,
                                                      const SettledFrame& settled, const FrameSpec& asked,
                                                      const BakeProgress& progress) {
  std::vector<LightMapCache::Found> found;
  const ResolvedFrame& frame = settled.frame;
  for (const int light : lightsToBake(frame)) {
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

Result<BakedScene> bakeScene(FrameCaches& caches, const std::shared_ptr<const Scene>& scene, const FrameSpec& spec,
                             const BakeListener& listener) {
  const auto start = std::chrono::steady_clock::now();
  auto settled = settleFrame(scene, bakedParts(spec), nullptr);
  if (!settled) return settled.problems();
  std::vector<int> lights = lightsToBake(settled->frame);
  if (lights.empty()) {
    return Problem{ProblemCode::invalidValue, "/shadow/technique",
                   "There is nothing to bake: no light that casts a shadow has technique lightMap.", "lightMap", ""};
  }
  const auto progress = [&](int light, double share) {
    const auto done = std::find(lights.begin(), lights.end(), light) - lights.begin();
    return !listener || listener({{}, light, share, static_cast<int>(done), static_cast<int>(lights.size())});
  };
  auto found = bakedLights(caches.lightMaps, caches.traced, *settled, spec, progress);
  if (!found) return found.problems();
  return BakedScene{std::move(settled->scene), std::move(settled->frame), std::move(lights), *std::move(found),
                    millisecondsSince(start)};
}

BakeReport reportOf(const BakedScene& baked) {
  BakeReport report;
  for (const int light : baked.lights) {
    report.lights.push_back({light, lightMapReport(baked.found[static_cast<std::size_t>(light)])});
  }
  report.milliseconds = baked.milliseconds;
  return report;
}

} // namespace gnomon
