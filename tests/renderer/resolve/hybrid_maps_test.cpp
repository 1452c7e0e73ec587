#include <gtest/gtest.h>

#include "renderer/resolve/plan_input.h"

namespace gnomon {
namespace {

/// A frame with one hybrid sun of four tiles.
ResolvedFrame frameOf(int width, int height, int baseSize) {
  ResolvedFrame frame;
  frame.spec.width = width;
  frame.spec.height = height;
  frame.spec.atlas.baseSize = baseSize;
  Light sun;
  sun.shadow = Shadow{};
  sun.shadow->technique = ShadowTechnique::hybrid;
  sun.shadow->cascadeCount = 4;
  frame.spec.lights = {sun};
  return frame;
}

SceneView sceneOf(std::uint64_t triangles) {
  SceneView scene;
  scene.triangles = triangles;
  return scene;
}

bool draws(const ResolvedFrame& frame, std::uint64_t triangles, bool software) {
  RendererInfo device;
  device.software = software;
  return drawsHybridMap(frame, sceneOf(triangles), 0, device);
}

TEST(HybridMaps, AreLeftOutWhereRaysCostLess) {
  EXPECT_FALSE(draws(frameOf(1280, 720, 1024), 600'000, true));
  EXPECT_FALSE(draws(frameOf(64, 64, 1024), 600, true));
}

TEST(HybridMaps, AreDrawnWhereManyPixelsAskAFewTriangles) {
  EXPECT_TRUE(draws(frameOf(3840, 2160, 1024), 10'000, true));
  EXPECT_FALSE(draws(frameOf(3840, 2160, 1024), 10'000'000, true));
}

TEST(HybridMaps, AreDrawnOnEveryGpu) {
  EXPECT_TRUE(draws(frameOf(64, 64, 1024), 600'000, false));
}

TEST(HybridMaps, AreLeftOutForLightsWithASize) {
  ResolvedFrame frame = frameOf(3840, 2160, 1024);
  (*frame.spec.lights)[0].angularDiameterDegrees = 0.53;
  EXPECT_FALSE(draws(frame, 10'000, true));
  EXPECT_FALSE(draws(frame, 10'000, false));
  frame.spec.views = {View::tile};
  EXPECT_TRUE(draws(frame, 10'000, true));
  frame.spec.views = {View::color};
  (*frame.spec.lights)[0].angularDiameterDegrees = 0;
  EXPECT_TRUE(draws(frame, 10'000, false));
}

TEST(HybridMaps, AreDrawnWhereAViewShowsThem) {
  ResolvedFrame frame = frameOf(64, 64, 1024);
  frame.spec.views = {View::color, View::depth};
  EXPECT_FALSE(draws(frame, 600, true));
  frame.spec.views = {View::color, View::cascades};
  EXPECT_TRUE(draws(frame, 600, true));
}

} // namespace
} // namespace gnomon
