#include "protocol/spec/unused_settings.h"

#include <array>

#include "protocol/spec/frame_lights.h"
#include "protocol/spec/traits.h"

namespace gnomon {
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
