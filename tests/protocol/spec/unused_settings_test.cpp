#include <gmock/gmock.h>

#include "protocol/spec/frame_lights.h"

namespace gnomon {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

Shadow by(ShadowTechnique technique) {
  Shadow shadow;
  shadow.technique = technique;
  return shadow;
}

Light lightWith(LightType type, const Shadow& shadow) {
  FrameSpec spec;
  spec.lights = {Light{.type = type}};
  spec.shadow = shadow;
  return lightsOf(spec, {}).front();
}

TEST(UnusedSettings, DefaultsAreNoneOfThem) {
  for (const ShadowTechnique technique : {ShadowTechnique::shadowMap, ShadowTechnique::shadowVolume,
                                          ShadowTechnique::rayTraced, ShadowTechnique::lightMap}) {
    for (const LightType type : {LightType::directional, LightType::spot, LightType::point}) {
      EXPECT_THAT(unusedSettings(lightWith(type, by(technique)), false), IsEmpty());
    }
  }
}

TEST(UnusedSettings, AreThoseOfOtherTechniques) {
  Shadow shadow = by(ShadowTechnique::rayTraced);
  shadow.cascadeCount = 2;
  shadow.size = ShadowSize::Small;
  shadow.filter.type = FilterType::msm;
  shadow.lightMap.size = 512;
  shadow.raySamples = 4;
  Light sun = lightWith(LightType::directional, shadow);
  EXPECT_THAT(unusedSettings(sun, false), ElementsAre("size", "cascadeCount", "filter", "lightMap", "raySamples"));
  EXPECT_THAT(unusedSettings(sun, true), ElementsAre("lightMap", "raySamples")) << "its map is shown";
  sun.angularDiameterDegrees = 1;
  EXPECT_THAT(unusedSettings(sun, true), ElementsAre("lightMap")) << "a light with a size takes many rays";
}

TEST(UnusedSettings, CascadesAreOfSuns) {
  Shadow shadow = by(ShadowTechnique::shadowMap);
  shadow.cascadeCount = 2;
  shadow.partition.pssmFactor = 1;
  EXPECT_THAT(unusedSettings(lightWith(LightType::directional, shadow), true), IsEmpty());
  EXPECT_THAT(unusedSettings(lightWith(LightType::spot, shadow), true), ElementsAre("cascadeCount", "partition"));
}

} // namespace
} // namespace gnomon
