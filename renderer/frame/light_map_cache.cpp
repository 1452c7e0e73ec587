#include "renderer/frame/light_map_cache.h"

#include <algorithm>
#include <chrono>
#include <iterator>
#include <set>

#include "protocol/base/elapsed.h"
#include "protocol/spec/traits.h"
#include "renderer/bake/bake_environment.h"
#include "renderer/bake/bake_light_map.h"
#include "renderer/bake/light_map_file.h"
#include "renderer/core/stop.h"

namespace gnomon {

ShadowSource sourceOf(const Light& light) {
  Light shadow = light;
  const Light plain;
  shadow.range = plain.range; // what lies beyond it is not lit, whatever the map holds
  shadow.innerConeDegrees = plain.innerConeDegrees;
  shadow.outerConeDegrees = plain.outerConeDegrees;
  shadow.color = plain.color;
  shadow.temperatureKelvin = plain.temperatureKelvin;
  shadow.intensity = plain.intensity;
  Shadow kept;
  kept.lightMap = light.shadow->lightMap;
  kept.blendedCasters = light.shadow->blendedCasters;
  kept.terminator = Terminator::flat; // whichever side of a triangle a map serves
  shadow.shadow = kept;
  return {shadow};
}

ShadowSource sourceOf(const BakedEnvironment& environment) {
  EnvironmentOptions shadow = environment.options;
  const EnvironmentOptions plain;
  shadow.intensity = plain.intensity;
  shadow.background = plain.background;
  Shadow kept;
  kept.lightMap = environment.map;
  kept.lightMap.samples = LightMapOptions{}.samples; // of lights
  return {Light{.shadow = kept}, shadow};
}

namespace {

LightMapFineness finenessOf(const LightMapOptions& options) {
  if (options.texelsPerMetre) return {options.texelsPerMetre, {}};
  return {{}, options.size};
}

/// A place from which the whole scene is seen: surfaces that are one to a camera there are one to the map.
glm::dvec3 fromAfar(const SceneView& view) {
  const double extent = view.bounds.empty() ? 0.0 : glm::length(view.bounds.max - view.bounds.min);
  return anchorOf(view) + glm::dvec3(0, extent, 0);
}

std::size_t bytesOf(const LightMapLayout& layout) {
  std::size_t bytes = layout.corners.capacity() * sizeof(layout.corners[0]);
  for (const PlacedChart& chart : layout.charts) {
    bytes += sizeof(PlacedChart) + chart.triangles.capacity() * sizeof(chart.triangles[0]);
  }
  return bytes;
}

Problem stopped() {
  return {ProblemCode::unavailable, "", "The bake was stopped.", "", ""};
}

/// Frames look up those of lights.
std::shared_ptr<const BakedLight> toBeKept(BakedLight baked, bool ofLight) {
  if (!ofLight) return std::make_shared<const BakedLight>(std::move(baked));
  baked.even = evenBlocks(baked.map);
  baked.evenTriangles = evenTriangles(baked.map, baked.even, baked.layout->corners);
  return std::make_shared<const BakedLight>(std::move(baked));
}

} // namespace

/// A map that one thread makes: those that want the same wait as long as this lives.
class LightMapCache::Claim {
 public:
  Claim(LightMapCache& cache, Key key) : cache_(cache) {
    cache_.making_.push_front(std::move(key));
    mine_ = cache_.making_.begin();
  }
  ~Claim() {
    {
      const std::lock_guard lock(cache_.mutex_);
      cache_.making_.erase(mine_);
    }
    cache_.changed_.notify_all();
  }
  Claim(const Claim&) = delete;
  Claim& operator=(const Claim&) = delete;

 private:
  LightMapCache& cache_;
  std::list<Key>::iterator mine_;
};

bool LightMapCache::isOf(const Key& key, const BakeInput& input, const ShadowSource& source) {
  return key.index == input.index && key.source == source && key.scene.lock() == input.scene &&
         std::equal(key.nodes.begin(), key.nodes.end(), input.nodes.begin(), input.nodes.end());
}

/// With the mutex held.
std::shared_ptr<const BakedLight> LightMapCache::kept(const BakeInput& input, const ShadowSource& source) {
  const Entry* const found = entries_.findIf([&](const Entry& entry) { return isOf(entry.key, input, source); });
  return found ? found->baked : nullptr;
}

std::shared_ptr<const LightMapLayout> LightMapCache::keptLayout(const BakeInput& input,
                                                                const LightMapOptions& options) {
  const std::lock_guard lock(mutex_);
  const auto found = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& entry) {
    const LightMapOptions& other = entry.key.source.light.shadow->lightMap;
    return entry.key.index == input.index && entry.key.scene.lock() == input.scene &&
           other.texelsPerMetre == options.texelsPerMetre && (options.texelsPerMetre || other.size == options.size);
  });
  return found == entries_.end() ? nullptr : found->baked->layout;
}

Result<LightMapCache::Found> LightMapCache::make(const BakeInput& input, const ShadowSource& source, const Bake& bake,
                                                 const Progress& progress) {
  const LightMapOptions& options = source.light.shadow->lightMap;
  const auto start = std::chrono::steady_clock::now();
  BakedLight baked{keptLayout(input, options), {}, 0};
  if (!baked.layout) {
    const GoOn goOn = progress ? GoOn([&] { return progress(0); }) : GoOn();
    auto made =
        untilStopped(goOn, [&] { return lightMapLayout(*input.scene, input.traced.view(), finenessOf(options)); });
    if (!made) return made.problems();
    baked.layout = std::make_shared<const LightMapLayout>(std::move(*made));
  }
  const bool ofLight = !source.environment;
  const bool inStore = store_ && !input.keyInStore.empty();
  if (const auto file = inStore ? store_->read(input.keyInStore) : std::nullopt) {
    const BakedPlanes planes = ofLight ? BakedPlanes::one : BakedPlanes::rgb;
    if (auto stored = readLightMapFile(*file, baked.layout, planes)) {
      return Found{toBeKept(*std::move(stored), ofLight), true};
    }
  }
  auto maps = bake({.eye = fromAfar(input.traced.view())}, *baked.layout);
  if (!maps) return stopped();
  baked.map = std::move(maps->front());
  if (!ofLight) baked.greenAndBlue = {std::move((*maps)[1]), std::move((*maps)[2])};
  baked.milliseconds = millisecondsSince(start);
  if (inStore) store_->write(input.keyInStore, lightMapFile(baked));
  return Found{toBeKept(std::move(baked), ofLight), false};
}

Result<LightMapCache::Found> LightMapCache::get(const BakeInput& input, int index, const Progress& progress) {
  const ShadowSource source = sourceOf(input.lights[static_cast<std::size_t>(index)]);
  const auto bake = [&](const CameraView& camera, const LightMapLayout& layout) {
    // Towards a light without an end: its cone and range decide where it shines, and not what its shadow is.
    std::vector<Light> lights(input.lights.begin(), input.lights.end());
    Light& open = lights[static_cast<std::size_t>(index)];
    open.range.reset();
    if (traitsOf(open.type).hasCone) open.type = LightType::point;
    const TraceInput rays{input.traced, camera, 1, 1, lights, input.nodes};
    std::optional<std::vector<LightMap>> maps;
    auto map = bakeLightMap(rays, index, layout, source.light.shadow->lightMap.samples, progress);
    if (map) maps.emplace().push_back(*std::move(map));
    return maps;
  };
  return get(input, source, bake, progress);
}

Result<LightMapCache::Found> LightMapCache::get(const BakeInput& input, const BakedEnvironment& environment,
                                                const Progress& progress) {
  const auto bake = [&](const CameraView& camera, const LightMapLayout& layout) {
    const TraceInput rays{input.traced, camera, 1, 1, {}, input.nodes};
    std::optional<std::vector<LightMap>> maps;
    auto baked = bakeEnvironment(rays, environment.sky, layout, environment.options.samples, progress);
    if (baked) maps.emplace(std::make_move_iterator(baked->begin()), std::make_move_iterator(baked->end()));
    return maps;
  };
  return get(input, sourceOf(environment), bake, progress);
}

Result<LightMapCache::Found> LightMapCache::get(const BakeInput& input, const ShadowSource& source, const Bake& bake,
                                                const Progress& progress) {
  constexpr std::chrono::milliseconds kAskAgain{20};
  const Key key{input.scene, input.index, source, {input.nodes.begin(), input.nodes.end()}};
  const auto beingMade = [&] {
    return std::any_of(making_.begin(), making_.end(), [&](const Key& each) { return isOf(each, input, source); });
  };
  std::unique_lock lock(mutex_);
  while (beingMade()) {
    changed_.wait_for(lock, kAskAgain);
    lock.unlock();
    stopIfAsked();
    if (progress && !progress(0)) return stopped();
    lock.lock();
  }
  if (auto found = kept(input, source)) return Found{std::move(found), true};
  const Claim claim(*this, key);
  lock.unlock();

  auto made = make(input, source, bake, progress);
  if (!made) return made;
  lock.lock();
  entries_.add({key, made->baked});
  drop();
  lock.unlock(); // before the claim ends, which locks
  return made;
}

/// With the mutex held.
void LightMapCache::drop() {
  entries_.eraseIf([](const Entry& entry) { return entry.key.scene.expired(); });
  std::set<const LightMapLayout*> layouts;
  entries_.keepWithin(budgetBytes_, [&layouts](const Entry& entry) {
    const BakedLight& baked = *entry.baked;
    return baked.bytes() + (layouts.insert(baked.layout.get()).second ? bytesOf(*baked.layout) : 0);
  });
}

} // namespace gnomon
