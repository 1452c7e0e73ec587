#include "renderer/frame/settle_frame.h"

#include <gtest/gtest.h>

#include "renderer/frame/frame.h"
#include "tests/renderer/frame/squares.h"

namespace gnomon {
namespace {

RendererInfo smallDevice() {
  RendererInfo device;
  device.device = DeviceChoice::cpu;
  device.maxTextureSize = 4096;
  device.maxSamples = 1;
  return device;
}

NodeOptions hidden(int node) {
  NodeOptions options;
  options.node = node;
  options.visible = false;
  return options;
}

std::vector<std::string> pointersOf(const Problems& problems) {
  std::vector<std::string> pointers;
  for (const Problem& problem : problems) pointers.push_back(problem.pointer);
  return pointers;
}

std::vector<std::string> refused(const FrameSpec& spec) {
  const RendererInfo device = smallDevice();
  const auto settled = settleFrame(testing::squares(), spec, &device);
  EXPECT_FALSE(settled);
  return settled ? std::vector<std::string>{} : pointersOf(settled.problems());
}

/// Wrong in all that a scene and a device can refuse together.
FrameSpec wrong() {
  FrameSpec spec;
  spec.width = 8192;
  spec.atlas.samples = 4;
  spec.animation = AnimationMoment{};
  spec.animation->index = 3;
  spec.materialVariant = "none";
  spec.nodes = {hidden(0), hidden(7)};
  spec.camera.node = "nobody";
  spec.lights = std::vector<Light>(17);
  spec.lights->back().shadow = Shadow{};
  spec.lights->back().shadow->technique = ShadowTechnique::shadowVolume;
  spec.debug.light = 17;
  VolumeOptions volume;
  volume.file = "none.npy";
  volume.node = 5;
  spec.volumes = {volume};
  spec.views = {View::color, View::motion};
  spec.motionFrom = MotionFrom{};
  spec.motionFrom->nodes = std::vector{hidden(0)};
  spec.motionFrom->camera = Camera{};
  spec.motionFrom->camera->node = "before";
  return spec;
}

TEST(SettleFrame, EveryProblemIsToldAtOnceAndOnce) {
  EXPECT_EQ(refused(wrong()), (std::vector<std::string>{"/animation/index", "/materialVariant", "/nodes/1/node",
                                                        "/camera/node", "/debug/light", "/volumes/0/node", "/width",
                                                        "/atlas/samples", "/lights/16/shadow/technique",
                                                        "/motionFrom/camera/node", "/lights", "/volumes/0/file"}));
}

TEST(SettleFrame, WhereTheSceneIsMissingItsPartsAreNotLookedFor) {
  FrameSpec spec = wrong();
  spec.scene = 4;
  EXPECT_EQ(refused(spec),
            (std::vector<std::string>{"/animation/index", "/scene", "/materialVariant", "/nodes/1/node", "/width",
                                      "/atlas/samples", "/lights/16/shadow/technique", "/lights", "/volumes/0/file"}));
}

TEST(SettleFrame, WithoutADeviceNothingIsRefusedForOne) {
  FrameSpec spec;
  spec.width = 8192;
  spec.atlas.samples = 4;
  spec.shadow.technique = ShadowTechnique::shadowVolume;
  EXPECT_TRUE(settleFrame(testing::squares(), spec, nullptr));
  EXPECT_EQ(refused(spec), (std::vector<std::string>{"/width", "/atlas/samples", "/shadow/technique"}));
}

TEST(SettleFrame, LayersOfRaysTakeWhatTheViewsNeed) {
  FrameSpec spec;
  spec.width = spec.height = 4096;
  spec.shadow.technique = ShadowTechnique::rayTraced;
  spec.antialiasing = Antialiasing::msaa4x;
  spec.lights = std::vector<Light>(5);
  EXPECT_EQ(refused(spec), (std::vector<std::string>{"/lights"})) << "640 MiB";
  spec.lights->pop_back();
  EXPECT_TRUE(settleFrame(testing::squares(), spec, nullptr));
  spec.lights->resize(16);
  spec.views = {View::shadow};
  EXPECT_TRUE(settleFrame(testing::squares(), spec, nullptr)) << "one sample a pixel";
  spec.lights->resize(17);
  EXPECT_FALSE(settleFrame(testing::squares(), spec, nullptr));
  spec.views = {View::depth};
  EXPECT_TRUE(settleFrame(testing::squares(), spec, nullptr)) << "no shadows at all";
}

TEST(SettleFrame, APlanRefusesAnAtlasAndWhatIsShownOfItTogether) {
  FrameSpec spec;
  spec.width = spec.height = 4096;
  spec.atlas = {.size = 8192, .baseSize = 4096, .samples = 4};
  spec.shadow.cascadeCount = 4;
  spec.views = {View::tile};
  spec.debug.tile = 5;
  RendererInfo device = smallDevice();
  device.maxTextureSize = 8192;
  device.maxSamples = 4;
  const auto plan = planFrame(testing::squares(), spec, device);
  ASSERT_FALSE(plan);
  EXPECT_EQ(pointersOf(plan.problems()), (std::vector<std::string>{"/atlas/size", "/debug/tile"}));
}

} // namespace
} // namespace gnomon
