#include "renderer/frame/bake_scene.h"

#include <algorithm>
#include <chrono>

#include "protocol/base/elapsed.h"
#include "protocol/spec/traits.h"
#include "renderer/frame/baked_lights.h"
#include "renderer/frame/make_report.h"
#include "renderer/frame/render_frame.h"
#include "renderer/resolve/plan_input.h"
#include "renderer/scene/animation/posed_scene.h"

namespace gnomon {
namespace {

std::vector<int> lightsToBake(const ResolvedFrame& frame) {
  std::vector<int> lights = layeredLights(frame);
  std::erase_if(lights, [&](int light) {
    return !traitsOf((*frame.spec.lights)[static_cast<std::size_t>(light)].shadow->technique).baked;
  });
  return lights;
}

} // namespace

Result<BakeReport> bakeScene(FrameCaches& caches, const std::shared_ptr<const Scene>& scene, const FrameSpec& spec,
                             const BakeListener& listener) {
  const auto start = std::chrono::steady_clock::now();
  const auto posed = posedScene(scene, spec.animation);
  if (!posed) return posed.problems();
  FrameSpec seen = spec;
  seen.camera = Camera{};
  const auto frame = resolveFrame(**posed, seen);
  if (!frame) return frame.problems();
  const std::vector<int> lights = lightsToBake(*frame);
  if (lights.empty()) {
    return Problem{ProblemCode::invalidValue, "/shadow/technique",
                   "There is nothing to bake: no light that casts a shadow has technique lightMap.", "lightMap", ""};
  }
  const auto progress = [&](int light, double share) {
    const auto done = std::find(lights.begin(), lights.end(), light) - lights.begin();
    return !listener || listener({{}, light, share, static_cast<int>(done), static_cast<int>(lights.size())});
  };
  const auto found = bakedLights(caches.lightMaps, caches.traced, {scene, *posed}, spec, *frame, progress);
  if (!found) return found.problems();
  BakeReport report;
  for (const int light : lights) {
    report.lights.push_back({light, lightMapReport((*found)[static_cast<std::size_t>(light)])});
  }
  report.milliseconds = millisecondsSince(start);
  return report;
}

} // namespace gnomon
