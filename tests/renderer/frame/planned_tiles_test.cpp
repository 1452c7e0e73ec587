#include <rapidcheck/gtest.h>

#include "protocol/spec/frame_lights.h"
#include "renderer/frame/frame.h"
#include "tests/renderer/frame/squares.h"

namespace gnomon {
namespace {

rc::Gen<Light> anyLight() {
  return rc::gen::exec([] {
    Light light;
    light.type = *rc::gen::element(LightType::directional, LightType::spot, LightType::point);
    light.direction = Vec3{0.3, -1, 0.2};
    if (light.type != LightType::directional) light.position = Vec3{0, 3, 0};
    if (light.type == LightType::point) light.direction.reset();
    if (light.type == LightType::spot) light.outerConeDegrees = *rc::gen::inRange(1, 90);
    light.innerConeDegrees = 0;
    light.intensity = *rc::gen::element(0.0, 1.0, 1.0);
    Shadow shadow;
    shadow.technique = ShadowTechnique::shadowMap;
    shadow.enabled = *rc::gen::arbitrary<bool>();
    shadow.cascadeCount = *rc::gen::inRange(1, 9);
    shadow.importance = *rc::gen::element(ShadowImportance::low, ShadowImportance::medium, ShadowImportance::high);
    if (*rc::gen::arbitrary<bool>()) shadow.size = *rc::gen::element(ShadowSize::XSmall, ShadowSize::XLarge);
    light.shadow = shadow;
    return light;
  });
}

/// What a request alone tells of its lights bounds what a plan makes of them.
RC_GTEST_PROP(PlannedTiles, AreNoMoreAndNoLargerThanARequestTells, ()) {
  FrameSpec spec;
  spec.width = *rc::gen::inRange(16, 3000);
  spec.height = *rc::gen::inRange(16, 3000);
  spec.shadowLightPolicy = *rc::gen::element(ShadowLightPolicy::all, ShadowLightPolicy::first);
  spec.atlas.baseSize = *rc::gen::element(256, 1024, 4096);
  spec.shadow.technique = ShadowTechnique::shadowMap;
  spec.lights = *rc::gen::container<std::vector<Light>>(anyLight());
  RendererInfo device;
  device.device = DeviceChoice::cpu;
  device.maxTextureSize = 16384;
  device.maxSamples = 4;
  const auto plan = planFrame(testing::squares(), spec, device);
  RC_ASSERT(plan.operator bool());
  const std::vector<Light> lights = lightsOf(spec, {});
  RC_ASSERT(lights == plan->spec.lights);
  const std::vector<int> throwing = shadowingLights(lights, spec.shadowLightPolicy);
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const LightReport& planned = plan->lights[i];
    const bool throws = std::find(throwing.begin(), throwing.end(), static_cast<int>(i)) != throwing.end();
    RC_ASSERT(planned.tiles.empty() || throws);
    RC_ASSERT(planned.tiles.size() <= static_cast<std::size_t>(tileCount(lights[i])));
    const Shadow& shadow = *lights[i].shadow;
    RC_ASSERT(planned.askedTileSize <= std::max(64, askedTileSize(*shadow.size, shadow.importance, spec.atlas.baseSize,
                                                                  std::max(spec.width, spec.height))));
  }
}

} // namespace
} // namespace gnomon
