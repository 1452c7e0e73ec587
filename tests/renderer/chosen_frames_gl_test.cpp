// Random scenes and specs by both devices; the fuzz target `devices` looks for more of the same.
#include <cstdio>
#include <random>

#include "protocol/json/json_codec.h"
#include "protocol/spec/frame_lights.h"
#include "renderer/render.h"
#include "tests/support/chosen_spec.h"
#include "tests/support/same_frames.h"

namespace gnomon {
namespace {

Result<Renderer> rendererBy(DeviceChoice device) {
  return Renderer::create({.backend = {.device = device}, .gpuSceneBytes = 0, .tileCacheBytes = 0});
}

Result<Frame> drawn(Renderer& renderer, const ScenePtr& scene, FrameSpec spec) {
  spec.device = renderer.info().device;
  return renderer.render(scene, spec);
}

std::vector<std::uint8_t> randomBytes(std::uint32_t seed) {
  std::mt19937 random(seed);
  std::vector<std::uint8_t> bytes(1500);
  for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random());
  return bytes;
}

TEST(ChosenFrames, BothDevicesDrawTheSameOrRefuseTheSame) {
  auto cpu = rendererBy(DeviceChoice::cpu);
  auto gl = rendererBy(DeviceChoice::gl);
  ASSERT_TRUE(cpu && gl);
  int compared = 0, otherPlans = 0;
  for (std::uint32_t seed = 0; seed < 60; ++seed) {
    const testing::ChosenFrame chosen = testing::chosenFrame(randomBytes(seed));
    const auto scene = loadScene({chosen.glb, {}});
    ASSERT_TRUE(scene) << scene.problems()[0].pointer << ' ' << scene.problems()[0].detail;
    const auto spec = decodeFrameSpec(chosen.spec.dump());
    if (!spec || !placesOfShadowVolumes(*spec).empty()) continue;
    const auto here = drawn(*cpu, *scene, *spec);
    const auto there = drawn(*gl, *scene, *spec);
    ASSERT_EQ(static_cast<bool>(here), static_cast<bool>(there)) << seed;
    if (!here) {
      EXPECT_EQ(here.problems()[0].detail, there.problems()[0].detail) << seed;
      continue;
    }
    ++compared;
    const testing::FrameDifference difference = testing::differenceOf(*here, *there);
    EXPECT_EQ(difference.what, "") << seed;
    otherPlans += difference.otherPlans ? 1 : 0;
  }
  std::printf("%d frames compared, %d of them planned otherwise\n", compared, otherPlans);
  EXPECT_GT(compared, 30);
  EXPECT_LE(otherPlans, compared / 2) << "maps of the others alone were compared";
}

} // namespace
} // namespace gnomon
