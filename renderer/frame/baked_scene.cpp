#include "renderer/frame/baked_scene.h"

#include <algorithm>
#include <chrono>

#include "protocol/base/elapsed.h"
#include "renderer/frame/make_report.h"
#include "renderer/frame/render_frame.h"
#include "renderer/resolve/plan_input.h"
#include "renderer/scene/animation/posed_scene.h"

namespace gnomon {
namespace {

std::vector<int> lightsToBake(const ResolvedFrame& frame) {
  std::vector<int> lights = layeredLights(frame);
  std::erase_if(lights, [&](int light) { return !techniqueOf(frame, light).baked; });
  return lights;
}

} // namespace

Result<BakedScene> bakeScene(FrameCaches& caches, const std::shared_ptr<const Scene>& scene, const FrameSpec& spec,
                             const BakeListener& listener) {
  const auto start = std::chrono::steady_clock::now();
  const auto posed = posedScene(scene, poseOf(spec));
  if (!posed) return posed.problems();
  FrameSpec seen = spec;
  seen.camera = Camera{};
  auto frame = resolveFrame(**posed, seen);
  if (!frame) return frame.problems();
  std::vector<int> lights = lightsToBake(*frame);
  if (lights.empty()) {
    return Problem{ProblemCode::invalidValue, "/shadow/technique",
                   "There is nothing to bake: no light that casts a shadow has technique lightMap.", "lightMap", ""};
  }
  const auto progress = [&](int light, double share) {
    const auto done = std::find(lights.begin(), lights.end(), light) - lights.begin();
    return !listener || listener({{}, light, share, static_cast<int>(done), static_cast<int>(lights.size())});
  };
  auto found = bakedLights(caches.lightMaps, caches.traced, {scene, *posed}, spec, *frame, progress);
  if (!found) return found.problems();
  return BakedScene{*posed, *std::move(frame), std::move(lights), *std::move(found), millisecondsSince(start)};
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
