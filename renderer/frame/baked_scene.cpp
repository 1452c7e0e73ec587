#include "renderer/frame/baked_scene.h"

#include <algorithm>
#include <chrono>

#include "protocol/bake/bake.h"
#include "protocol/base/elapsed.h"
#include "renderer/core/collect.h"
#include "renderer/environment/frame_sampler.h"
#include "renderer/frame/environment_of_frame.h"
#include "renderer/frame/make_report.h"
#include "renderer/frame/render_frame.h"
#include "renderer/frame/settle_frame.h"
#include "renderer/resolve/check_frame.h"
#include "renderer/resolve/plan_input.h"

namespace gnomon {
namespace {

/// Changes with all that the shadow depends on. Empty where the scene has no id.
std::string keyInStore(const Scene& scene, const FrameSpec& effective, const ShadowSource& source) {
  const std::string& id = scene.summary.id;
  if (id.empty()) return {};
  FrameSpec spec = effective;
  spec.lights = std::vector{source.light};
  spec.environment = source.environment.value_or(EnvironmentOptions{});
  spec.shadow = Shadow{};
  spec.ambient = {};
  return id + "-" + bakeKey(id, spec);
}

/// Bakes what arrives of the environment, as finely as the first of the lights, or where none is baked as the frame's
/// shadows.
Status bakeSurroundings(FrameCaches& caches, SettledFrame& settled, const FrameSpec& asked, const Progress& progress,
                        BakedScene& baked) {
  const ResolvedFrame& frame = settled.frame;
  auto around = environmentOf(caches.environments, settled);
  if (!around) return around.problems();
  baked.around = *std::move(around);
  const auto rays = caches.traced.get(settled.scene, frame.scene);
  if (!rays) return rays.problems();
  const bool alone = baked.lights.empty();
  const std::size_t first = alone ? 0 : static_cast<std::size_t>(baked.lights.front());
  const SkyLight sky = skyLightOf(&baked.around);
  const BakedEnvironment environment{sky, frame.spec.environment,
                                     alone ? frame.spec.shadow.lightMap : (*frame.spec.lights)[first].shadow->lightMap};
  const std::string key =
      caches.lightMaps.hasStore() ? keyInStore(*settled.loaded, frame.spec, sourceOf(environment)) : std::string();
  auto found = caches.lightMaps.get({settled.scene, frame.scene, **rays, *frame.spec.lights, frame.nodes, key},
                                    environment, progress);
  if (!found) {
    if (found.problems().front().code == ProblemCode::unavailable) return found.problems();
    const std::string place = alone ? "/shadow" : shadowPlace(asked, baked.lights.front());
    return placedAt(place + "/lightMap", found.problems());
  }
  baked.environment = *std::move(found);
  return Done{};
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
    const ShadowSource source = sourceOf((*frame.spec.lights)[static_cast<std::size_t>(light)]);
    const std::string key = maps.hasStore() ? keyInStore(*settled.loaded, frame.spec, source) : std::string();
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
  BakedScene baked;
  baked.lights = lightsToBake(settled->frame);
  const bool withSky = settled->frame.spec.environment.shadows == EnvironmentShadows::rays;
  if (baked.lights.empty() && !withSky) {
    return Problem{ProblemCode::invalidValue, "/shadow/technique",
                   "There is nothing to bake: no light that casts a shadow has technique lightMap, and "
                   "environment.shadows is not rays.",
                   "lightMap", ""};
  }
  const int of = static_cast<int>(baked.lights.size()) + (withSky ? 1 : 0);
  const auto progress = [&](int light, double share) {
    const auto done = std::find(baked.lights.begin(), baked.lights.end(), light) - baked.lights.begin();
    return !listener || listener({{}, light, share, static_cast<int>(done), of});
  };
  auto found = bakedLights(caches.lightMaps, caches.traced, *settled, spec, progress);
  if (!found) return found.problems();
  baked.found = *std::move(found);
  if (withSky) {
    const auto skyProgress = [&](double share) { return !listener || listener({{}, {}, share, of - 1, of}); };
    const Status made = bakeSurroundings(caches, *settled, spec, skyProgress, baked);
    if (!made) return made.problems();
  }
  baked.scene = std::move(settled->scene);
  baked.frame = std::move(settled->frame);
  baked.milliseconds = millisecondsSince(start);
  return baked;
}

BakeReport reportOf(const BakedScene& baked) {
  BakeReport report;
  for (const int light : baked.lights) {
    report.lights.push_back({light, lightMapReport(baked.found[static_cast<std::size_t>(light)])});
  }
  if (baked.environment.baked) report.environment = lightMapReport(baked.environment);
  report.milliseconds = baked.milliseconds;
  return report;
}

} // namespace gnomon
