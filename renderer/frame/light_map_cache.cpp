#include "renderer/frame/light_map_cache.h"

#include <algorithm>
#include <chrono>
#include <set>

#include "protocol/base/elapsed.h"
#include "renderer/bake/bake_light_map.h"

namespace gnomon {
namespace {

/// The light without what its shadow does not depend on: two lights that are the same then share a map.
Light shadowOf(const Light& light) {
  Light shadow = light;
  const Light plain;
  shadow.range = plain.range; // what lies beyond it is not lit, whatever the map says
  shadow.innerConeDegrees = plain.innerConeDegrees;
  shadow.outerConeDegrees = plain.outerConeDegrees;
  shadow.color = plain.color;
  shadow.temperatureKelvin = plain.temperatureKelvin;
  shadow.intensity = plain.intensity;
  Shadow kept;
  kept.lightMap = light.shadow->lightMap;
  kept.blendedCasters = light.shadow->blendedCasters;
  shadow.shadow = kept;
  return shadow;
}

LightMapFineness finenessOf(const LightMapOptions& options) {
  if (options.texelsPerMetre) return {options.texelsPerMetre, {}};
  return {{}, options.size};
}

std::size_t bytesOf(const LightMapLayout& layout) {
  std::size_t bytes = layout.corners.capacity() * sizeof(layout.corners[0]);
  for (const PlacedChart& chart : layout.charts) {
    bytes += sizeof(PlacedChart) + chart.triangles.capacity() * sizeof(chart.triangles[0]);
  }
  return bytes;
}

} // namespace

bool LightMapCache::isOf(const Entry& entry, const BakeInput& input, const Light& light) {
  return entry.key.index == input.index && entry.key.light == light && entry.key.scene.lock() == input.scene &&
         std::equal(entry.key.nodes.begin(), entry.key.nodes.end(), input.nodes.begin(), input.nodes.end());
}

std::shared_ptr<const LightMapLayout> LightMapCache::keptLayout(const BakeInput& input,
                                                                const LightMapOptions& options) const {
  const auto found = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& entry) {
    const LightMapOptions& other = entry.key.light.shadow->lightMap;
    return entry.key.index == input.index && entry.key.scene.lock() == input.scene &&
           other.texelsPerMetre == options.texelsPerMetre && (options.texelsPerMetre || other.size == options.size);
  });
  return found == entries_.end() ? nullptr : found->baked->layout;
}

Result<LightMapCache::Found> LightMapCache::get(const BakeInput& input, int index) {
  const Light& source = input.lights[static_cast<std::size_t>(index)];
  const Light light = shadowOf(source);
  const std::lock_guard lock(mutex_);
  const auto found =
      std::find_if(entries_.begin(), entries_.end(), [&](const Entry& entry) { return isOf(entry, input, light); });
  if (found != entries_.end()) {
    entries_.splice(entries_.begin(), entries_, found);
    return Found{entries_.front().baked, true};
  }
  const auto start = std::chrono::steady_clock::now();
  const LightMapOptions& options = light.shadow->lightMap;
  BakedLight baked{keptLayout(input, options), {}, 0};
  if (!baked.layout) {
    auto made = lightMapLayout(*input.scene, input.traced.view(), finenessOf(options));
    if (!made) return made.problems();
    baked.layout = std::make_shared<const LightMapLayout>(std::move(*made));
  }
  // By a light without an end: its cone and range decide where it shines, and not what its shadow is.
  const CameraView camera{.eye = anchorOf(input.traced.view())};
  std::vector<Light> lights(input.lights.begin(), input.lights.end());
  Light& open = lights[static_cast<std::size_t>(index)];
  open.range.reset();
  if (open.type == LightType::spot) open.type = LightType::point;
  const TraceInput rays{input.traced, camera, 1, 1, lights, input.nodes};
  baked.map = *bakeLightMap(rays, index, *baked.layout, options.samples, {});
  baked.milliseconds = millisecondsSince(start);
  entries_.push_front({{input.scene, input.index, light, {input.nodes.begin(), input.nodes.end()}},
                       std::make_shared<const BakedLight>(std::move(baked))});
  drop();
  return Found{entries_.front().baked, false};
}

void LightMapCache::drop() {
  entries_.remove_if([](const Entry& entry) { return entry.key.scene.expired(); });
  std::set<const LightMapLayout*> layouts;
  std::size_t bytes = 0;
  auto entry = entries_.begin();
  while (entry != entries_.end()) {
    bytes += entry->baked->bytes();
    if (layouts.insert(entry->baked->layout.get()).second) bytes += bytesOf(*entry->baked->layout);
    const bool keep = entry == entries_.begin() || bytes <= budgetBytes_;
    entry = keep ? std::next(entry) : entries_.erase(entry);
  }
}

} // namespace gnomon
