#include "protocol/spec/frame_lights.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

#include "protocol/spec/limits.h"
#include "protocol/spec/settled_sun.h"
#include "protocol/spec/traits.h"

namespace gnomon {
namespace {

std::vector<Light> chosenLights(const FrameSpec& spec, std::span<const Light> ofScene) {
  if (spec.lights) return *spec.lights;
  std::vector<Light> lights(ofScene.begin(), ofScene.end());
  lights.resize(std::min(lights.size(), static_cast<std::size_t>(kLimits.maxLights)));
  if (lights.empty() && isStudio(spec.environment)) {
    Light sun;
    sun.sun.emplace();
    sun.intensity = kUsualSunIntensity;
    lights.push_back(sun);
  }
  return lights;
}

} // namespace

std::vector<Light> lightsOf(const FrameSpec& spec, std::span<const Light> ofScene,
                            std::span<const Light> ofEnvironment) {
  std::vector<Light> lights = chosenLights(spec, ofScene);
  lights.insert(lights.end(), ofEnvironment.begin(), ofEnvironment.end());
  for (Light& light : lights) {
    if (light.sun) {
      if (isNight(*light.sun)) light.intensity = 0;
      light.sun = settledSun(*light.sun);
    }
    if (!light.color && !light.temperatureKelvin) light.color = Vec3{1, 1, 1};
    if (!light.shadow) light.shadow = spec.shadow;
    if (!light.shadow->size) light.shadow->size = traitsOf(light.type).usualSize;
  }
  return lights;
}

bool isStudio(const EnvironmentOptions& environment) {
  return !environment.file && !environment.sky && !environment.light;
}

EnvironmentOptions withSource(EnvironmentOptions environment, const std::optional<int>& ofScene) {
  if (!isStudio(environment) || environment.studio) return environment;
  environment.light = ofScene;
  if (!ofScene) environment.studio = Studio::lamps;
  return environment;
}

std::vector<Light> assumedSun(const EnvironmentOptions& environment) {
  if (isStudio(environment) || environment.extractSun == SunExtraction::removed) return {};
  if (!environment.sky && environment.extractSun == SunExtraction::none) return {};
  return {Light{.direction = Vec3{0, -1, 0}, .angularDiameterDegrees = 0.53}};
}

bool shines(const Light& light) {
  return light.intensity > 0 && (light.temperatureKelvin || light.color.value_or(Vec3{1, 1, 1}) != Vec3{0, 0, 0});
}

bool hasSize(const Light& light) {
  return (light.*traitsOf(light.type).size).value_or(0) > 0;
}

std::vector<int> shadowingLights(std::span<const Light> lights, ShadowLightPolicy policy) {
  std::vector<int> throwing;
  const bool firstOnly = policy == ShadowLightPolicy::first;
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const Light& light = lights[i];
    if (firstOnly && !traitsOf(light.type).parallel) continue;
    if (light.shadow->enabled && shines(light)) throwing.push_back(static_cast<int>(i));
    if (firstOnly) break; // the first is the first, with a shadow or without
  }
  return throwing;
}

std::vector<int> mappedLights(std::span<const Light> lights, const FrameSpec& spec) {
  const bool shown = std::any_of(spec.views.begin(), spec.views.end(), [](View view) { return traitsOf(view).tiles; });
  std::vector<int> mapped = shadowingLights(lights, spec.shadowLightPolicy);
  if (!shown) {
    std::erase_if(
        mapped, [&](int light) { return traitsOf(lights[static_cast<std::size_t>(light)].shadow->technique).layered; });
  }
  return mapped;
}

int tileCount(const Light& light) {
  const LightTraits& kind = traitsOf(light.type);
  if (kind.parallel) return light.shadow->cascadeCount;
  return kind.hasCone && light.outerConeDegrees <= kWidestTileDegrees ? 1 : static_cast<int>(kind.cubeFaces);
}

int askedTileSize(ShadowSize size, ShadowImportance importance, int baseSize, int lightSize) {
  if (lightSize <= 0 || baseSize <= 0) return 0;
  // In 32nds of a texel every factor is a whole power of two, and nextPowerOfTwo scales with it.
  const int doublings = static_cast<int>(size) - static_cast<int>(ShadowSize::XSmall) + static_cast<int>(importance) -
                        static_cast<int>(ShadowImportance::low);
  const std::uint64_t byLight = std::bit_ceil(static_cast<std::uint64_t>(lightSize)) << doublings;
  const std::uint64_t byBase = static_cast<std::uint64_t>(baseSize) << doublings;
  return static_cast<int>(std::max<std::uint64_t>(1, std::min(byLight, byBase) / 32));
}

int samplesOf(Antialiasing antialiasing) {
  return antialiasing == Antialiasing::msaa4x ? 4 : 1;
}

namespace {

struct Setting {
  std::string_view name;
  bool (*isSet)(const Light& light);
  bool (*isUsed)(const Light& light, bool mapped);
};

template <auto kMember>
bool differs(const Light& light) {
  static const Shadow kUsual{};
  return (*light.shadow).*kMember != kUsual.*kMember;
}

bool byMap(const Light&, bool mapped) {
  return mapped;
}

bool byCascades(const Light& light, bool mapped) {
  return mapped && traitsOf(light.type).parallel;
}

const TechniqueTraits& techniqueOf(const Light& light) {
  return traitsOf(light.shadow->technique);
}

constexpr std::array kSettings{
    Setting{"size", [](const Light& light) { return light.shadow->size != traitsOf(light.type).usualSize; }, byMap},
    Setting{"importance", differs<&Shadow::importance>, byMap},
    Setting{"cascadeCount", differs<&Shadow::cascadeCount>, byCascades},
    Setting{"partition", differs<&Shadow::partition>, byCascades},
    // Sequences set a previous range and a stabilization for all lights.
    Setting{"depthRange", [](const Light& light) { return light.shadow->depthRange.mode == DepthRangeMode::manual; },
            byCascades},
    Setting{
        "stabilization",
        [](const Light& light) { return !light.shadow->depthRange.previous && differs<&Shadow::stabilization>(light); },
        byCascades},
    Setting{"blendCascades", differs<&Shadow::blendCascades>, byCascades},
    Setting{"bias", differs<&Shadow::bias>, byMap},
    Setting{"filter", differs<&Shadow::filter>, byMap},
    Setting{"terminator", differs<&Shadow::terminator>,
            [](const Light& light, bool) {
              return light.shadow->technique == ShadowTechnique::shadowMap ||
                     light.shadow->technique == ShadowTechnique::rayTraced;
            }},
    Setting{"lightMap", differs<&Shadow::lightMap>, [](const Light& light, bool) { return techniqueOf(light).baked; }},
    Setting{"raySamples", differs<&Shadow::raySamples>,
            [](const Light& light, bool) {
              return techniqueOf(light).traced && !techniqueOf(light).baked && hasSize(light);
            }},
};

} // namespace

std::vector<std::string_view> unusedSettings(const Light& light, bool mapped) {
  std::vector<std::string_view> unused;
  for (const Setting& setting : kSettings) {
    if (setting.isSet(light) && !setting.isUsed(light, mapped)) unused.push_back(setting.name);
  }
  return unused;
}

} // namespace gnomon
