#include "renderer/environment/frame_sampler.h"

#include <mutex>
#include <utility>
#include <vector>

#include "renderer/shaders/shared/functions.h"

namespace gnomon {
namespace {

using Kept = std::pair<std::weak_ptr<const Environment>, std::shared_ptr<const EnvironmentSampler>>;

std::shared_ptr<const EnvironmentSampler> makeStudioSampler(unsigned lamps) {
  constexpr int kAcross = 2;
  return std::make_shared<const EnvironmentSampler>(
      [lamps](const glm::dvec3& direction) {
        return glm::vec3(shared::radianceOfStudio(glm::vec3(direction), glm::vec2(1, 0), lamps, 0.0f));
      },
      kAcross);
}

std::shared_ptr<const EnvironmentSampler> studioSampler(bool lamps) {
  if (lamps) {
    static const auto withLamps = makeStudioSampler(1);
    return withLamps;
  }
  static const auto even = makeStudioSampler(0);
  return even;
}

std::shared_ptr<const EnvironmentSampler> samplerOf(const std::shared_ptr<const Environment>& of) {
  static std::mutex mutex;
  static std::vector<Kept> kept;
  const auto find = [&]() -> std::shared_ptr<const EnvironmentSampler> {
    std::erase_if(kept, [](const Kept& each) { return each.first.expired(); });
    for (const Kept& each : kept) {
      if (!each.first.owner_before(of) && !of.owner_before(each.first)) return each.second;
    }
    return nullptr;
  };
  {
    const std::lock_guard lock(mutex);
    if (auto found = find()) return found;
  }
  auto made = std::make_shared<const EnvironmentSampler>(of->map);
  const std::lock_guard lock(mutex);
  if (auto found = find()) return found;
  kept.emplace_back(of, made);
  return made;
}

} // namespace

SkyLight skyLightOf(const FrameEnvironment* environment) {
  if (environment == nullptr) return {studioSampler(true)};
  if (!environment->environment) return {studioSampler(environment->studioLamps), glm::mat3(environment->mapFromWorld)};
  return {samplerOf(environment->environment), glm::mat3(environment->mapFromWorld)};
}

} // namespace gnomon
