#include "renderer/environment/frame_sampler.h"

#include <mutex>
#include <utility>
#include <vector>

#include "renderer/shaders/shared/functions.h"

namespace gnomon {
namespace {

using Kept = std::pair<std::weak_ptr<const Environment>, std::shared_ptr<const EnvironmentSampler>>;

std::shared_ptr<const EnvironmentSampler> studioSampler() {
  constexpr int kAcross = 2;
  static const auto studio = std::make_shared<const EnvironmentSampler>(
      [](const glm::dvec3& direction) {
        return glm::vec3(shared::radianceAround(static_cast<float>(direction.y), 0.0f));
      },
      kAcross);
  return studio;
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
  if (environment == nullptr || !environment->environment) return {studioSampler()};
  return {samplerOf(environment->environment), glm::mat3(environment->mapFromWorld)};
}

} // namespace gnomon
