#include "protocol/cost/frame_cost.h"

#include <numeric>

#include "protocol/spec/enum_rows.h"

namespace gnomon {
namespace {

const SceneCounts kScene{100'000, {LightType::directional, LightType::point}};

double whole(const FrameSpec& spec, const SceneCounts& scene = kScene) {
  const FrameCost cost = frameCost(spec, scene);
  return std::accumulate(cost.parts.begin(), cost.parts.end(), 0.0);
}

double partOf(const FrameSpec& spec, FramePart part) {
  return frameCost(spec, kScene)[part];
}

FrameSpec sunlit(const std::function<void(FrameSpec&, Light&)>& change) {
  FrameSpec spec;
  Light sun;
  sun.angularDiameterDegrees = 0.53;
  change(spec, sun);
  spec.lights = {sun};
  return spec;
}

FrameSpec traced(int samples) {
  return sunlit([&](FrameSpec& spec, Light&) {
    spec.shadow.technique = ShadowTechnique::rayTraced;
    spec.shadow.raySamples = samples;
  });
}

TEST(FrameCost, GrowsWithAllThatAFrameIsAskedFor) {
  const auto changed = [](const std::function<void(FrameSpec&)>& change) {
    FrameSpec spec;
    change(spec);
    return whole(spec);
  };
  const double usual = whole(FrameSpec{});
  EXPECT_GT(changed([](FrameSpec& spec) { spec.width *= 2; }), usual);
  EXPECT_GT(changed([](FrameSpec& spec) { spec.views.push_back(View::normal); }), usual);
  EXPECT_GT(changed([](FrameSpec& spec) { spec.views.push_back(View::error); }), usual);
  EXPECT_GT(changed([](FrameSpec& spec) { spec.shadow.cascadeCount = 8; }), usual);
  EXPECT_GT(changed([](FrameSpec& spec) { spec.atlas.samples = 4; }), usual);
  EXPECT_GT(changed([](FrameSpec& spec) { spec.shadow.filter.type = FilterType::pcss; }), usual);
  EXPECT_GT(changed([](FrameSpec& spec) { spec.lights = std::vector<Light>(10); }), usual);
  EXPECT_GT(changed([](FrameSpec& spec) { spec.volumes.resize(1); }), usual);
  EXPECT_GT(changed([](FrameSpec& spec) { spec.debug.predictEdges = true; }), usual);
  EXPECT_LT(changed([](FrameSpec& spec) { spec.antialiasing = Antialiasing::none; }), usual);
  EXPECT_LT(changed([](FrameSpec& spec) { spec.shadow.enabled = false; }), usual);
  EXPECT_LT(changed([](FrameSpec& spec) { spec.shadowLightPolicy = ShadowLightPolicy::first; }), usual);
  EXPECT_GT(whole(FrameSpec{}, {1'000'000, kScene.lights}), usual);
}

TEST(FrameCost, EveryFormatHasItsCost) {
  for (const auto& spelled : kSpellings<ImageFormat>) {
    FrameSpec spec;
    spec.output.format = static_cast<ImageFormat>(spelled.value);
    EXPECT_GT(partOf(spec, FramePart::encode), 0) << spelled.name;
  }
  FrameSpec fine;
  fine.output.pngBits = 16;
  EXPECT_GT(partOf(fine, FramePart::encode), partOf(FrameSpec{}, FramePart::encode));
}

TEST(FrameCost, RaysAreCountedByPixelsSamplesAndLights) {
  EXPECT_GT(partOf(traced(256), FramePart::visibility), 6 * partOf(traced(16), FramePart::visibility));
  FrameSpec two = traced(16);
  two.lights->push_back(two.lights->front());
  EXPECT_DOUBLE_EQ(partOf(two, FramePart::visibility), 2 * partOf(traced(16), FramePart::visibility));
  FrameSpec wide = traced(16);
  wide.width *= 3;
  EXPECT_DOUBLE_EQ(partOf(wide, FramePart::visibility), 3 * partOf(traced(16), FramePart::visibility));
  FrameSpec point = traced(256);
  point.lights->front().angularDiameterDegrees = 0;
  FrameSpec other = traced(16);
  other.lights->front().angularDiameterDegrees = 0;
  EXPECT_DOUBLE_EQ(partOf(point, FramePart::visibility), partOf(other, FramePart::visibility))
      << "a light without a size takes one ray a pixel";
  EXPECT_EQ(partOf(traced(16), FramePart::shadow), 0);
}

TEST(FrameCost, TheWorstThatLimitsAllowTakesLong) {
  FrameSpec spec = traced(kLimits.maxRaySamples);
  spec.lights = std::vector<Light>(static_cast<std::size_t>(kLimits.maxLights), spec.lights->front());
  EXPECT_GT(whole(spec) * 1e-9, 300) << "seconds";
  EXPECT_LT(whole(FrameSpec{}) * 1e-9, 1);
}

TEST(FrameCost, WhatASceneBringsIsInItsSummary) {
  SceneSummary summary;
  summary.triangles = 12;
  summary.lights = {{.type = "spot"}, {.type = "directional"}, {.type = "point"}};
  const SceneCounts counts = sceneCounts(summary);
  EXPECT_EQ(counts.triangles, 12u);
  EXPECT_EQ(counts.lights, (std::vector{LightType::spot, LightType::directional, LightType::point}));
}

TEST(FrameCost, WithoutLightsTheSceneHasTheSun) {
  FrameSpec sun;
  sun.lights = {Light{}};
  EXPECT_DOUBLE_EQ(whole(FrameSpec{}, {100, {}}), whole(sun, {100, {}}));
  FrameSpec dark;
  dark.lights.emplace();
  dark.views = {View::error};
  EXPECT_LT(whole(dark, {100, {}}), whole(sun, {100, {}}));
}

} // namespace
} // namespace gnomon
