#include "renderer/frame/baked_scene.h"

#include <algorithm>
#include <chrono>

#include "protocol/bake/bake_json.h"
#include "protocol/base/elapsed.h"
#include "renderer/frame/make_report.h"
#include "renderer/frame/render_frame.h"
#include "renderer/frame/settle_frame.h"
#include "renderer/resolve/plan_input.h"

namespace gnomon {
namespace {

std::vector<int> lightsToBake(const SettledFrame& settled) {
  std::vector<int> lights = settled.layered;
  std::erase_if(lights, [&](int light) { return !techniqueOf(settled.frame, light).baked; });
  return lights;
}

} // namespace

Result<BakedScene> bakeScene(FrameCaches& caches, const std::shared_ptr<const Scene>& scene, const FrameSpec& spec,
                             const BakeListener& listener) {
  const auto start = std::chrono::steady_clock::now();
  auto settled = settleFrame(scene, bakedParts(spec), nullptr);
  if (!settled) return settled.problems();
  std::vector<int> lights = lightsToBake(*settled);
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
