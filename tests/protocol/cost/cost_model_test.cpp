#include "protocol/cost/cost_model.h"

#include <numeric>
#include <random>
#include <thread>

#include "protocol/cost/frame_cost.h"
#include "protocol/spec/enum_rows.h"

namespace gnomon {
namespace {

const SceneCounts kCity{300'000, {LightType::directional}};

FrameSpec randomSpec(std::mt19937& random) {
  const auto among = [&](std::initializer_list<int> values) {
    return values.begin()[std::uniform_int_distribution<std::size_t>(0, values.size() - 1)(random)];
  };
  FrameSpec spec;
  spec.width = among({320, 1280, 1920});
  spec.height = among({200, 720, 1080});
  spec.shadow.technique = static_cast<ShadowTechnique>(among({0, 0, 3}));
  spec.shadow.raySamples = among({1, 16, 64});
  spec.shadow.cascadeCount = among({1, 2, 4});
  spec.lights.emplace(static_cast<std::size_t>(among({1, 2, 5})));
  for (Light& light : *spec.lights) light.angularDiameterDegrees = 0.53;
  return spec;
}

/// A machine on which each part takes its own factor of the usual time, and up to a tenth more or less.
class Machine {
 public:
  FrameReport report(const FrameCost& cost) {
    const auto time = [&](FramePart part) {
      return 1e-6 * cost[part] * factors_[static_cast<std::size_t>(part)] * noise_(random_);
    };
    FrameReport report;
    const double visibility = time(FramePart::visibility);
    report.stages = {{"queue", 5000},
                     {"load", 700},
                     {"upload", time(FramePart::fixed)},
                     {"survey", time(FramePart::survey)},
                     {"shadow", time(FramePart::shadow)},
                     {"shade", visibility + time(FramePart::shade)},
                     {"readback", time(FramePart::readback)},
                     {"encode", time(FramePart::encode)}};
    report.passes = {{.pass = "survey", .cpuMilliseconds = 1}, {.pass = "visibility", .cpuMilliseconds = visibility}};
    return report;
  }

  double milliseconds(const FrameCost& cost) const {
    return 1e-6 * std::inner_product(cost.parts.begin(), cost.parts.end(), factors_.begin(), 0.0);
  }

 private:
  std::array<double, kFrameParts> factors_{2, 1, 1, 5, 0.3, 7, 0.5, 1, 1, 2, 4};
  std::uniform_real_distribution<double> noise_{0.9, 1.1};
  std::mt19937 random_{7};
};

TEST(CostModel, AfterTwentyFramesItTellsTheTimeOfOthersWithinAFifth) {
  std::mt19937 random(1);
  Machine machine;
  CostModel model;
  for (int i = 0; i < 20; ++i) {
    const FrameCost cost = frameCost(randomSpec(random), kCity);
    model.learn(cost, machine.report(cost));
  }
  for (int i = 0; i < 50; ++i) {
    const FrameCost cost = frameCost(randomSpec(random), kCity);
    EXPECT_NEAR(model.milliseconds(cost), machine.milliseconds(cost), 0.2 * machine.milliseconds(cost));
  }
}

TEST(CostModel, BeforeItHasSeenAnyItTakesTheUsualTimes) {
  const FrameCost cost = frameCost(FrameSpec{}, kCity);
  EXPECT_NEAR(CostModel().milliseconds(cost), 1e-6 * std::accumulate(cost.parts.begin(), cost.parts.end(), 0.0), 1e-9);
}

TEST(CostModel, ForgetsAMachineThatHasChanged) {
  const FrameCost cost = frameCost(FrameSpec{}, kCity);
  FrameReport slow, fast;
  slow.stages = {{"survey", 500}};
  fast.stages = {{"survey", 5}};
  CostModel model;
  for (int i = 0; i < 20; ++i) model.learn(cost, slow);
  EXPECT_NEAR(model.parts(cost)[FramePart::survey], 500, 25);
  for (int i = 0; i < 60; ++i) model.learn(cost, fast);
  EXPECT_NEAR(model.parts(cost)[FramePart::survey], 5, 1.5);
}

TEST(CostModel, WhatWasKeptFromEarlierFramesTeachesNothing) {
  FrameSpec spec;
  spec.shadow.technique = ShadowTechnique::lightMap;
  spec.volumes.resize(1);
  FrameCost cost = frameCost(spec, kCity);
  cost[FramePart::shadow] = 1e6;
  CostModel model;
  const FrameCost before = model.parts(cost);
  FrameReport report;
  report.stages = {{"shadow", 0}, {"bake", 0}, {"volume", 0}, {"survey", 0}};
  report.lights.resize(1);
  report.lights[0].tiles.resize(2);
  report.lights[0].tiles[1].reused = true;
  report.volumes = {{.reused = true}};
  for (int i = 0; i < 20; ++i) model.learn(cost, report);
  const FrameCost after = model.parts(cost);
  for (const FramePart part : {FramePart::shadow, FramePart::bake, FramePart::volume}) {
    EXPECT_EQ(after[part], before[part]);
  }
  EXPECT_LT(after[FramePart::survey], 0.2 * before[FramePart::survey]);
}

TEST(CostModel, TheSameFramesTeachTheSame) {
  const auto learned = [] {
    std::mt19937 random(3);
    Machine machine;
    CostModel model;
    for (int i = 0; i < 10; ++i) {
      const FrameCost cost = frameCost(randomSpec(random), kCity);
      model.learn(cost, machine.report(cost));
    }
    return model.milliseconds(frameCost(FrameSpec{}, kCity));
  };
  EXPECT_EQ(learned(), learned());
}

TEST(CostModel, AnyThreadMayAskAndTeach) {
  const FrameCost cost = frameCost(FrameSpec{}, kCity);
  FrameReport report;
  report.stages = {{"survey", 5}};
  CostModel model;
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i) {
    threads.emplace_back([&] {
      for (int frame = 0; frame < 200; ++frame) {
        model.learn(cost, report);
        EXPECT_GT(model.milliseconds(cost), 0);
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_NEAR(model.parts(cost)[FramePart::survey], 5, 0.1);
}

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

TEST(FrameCost, LightInVolumesGrowsWithVoxelsLightsAndTheVolumesPassedThrough) {
  const auto volumeCost = [](std::size_t volumes, double side, std::size_t lights) {
    FrameSpec spec;
    spec.volumes.resize(volumes);
    spec.lights = std::vector<Light>(lights);
    SceneCounts scene = kScene;
    scene.voxels = side * side * side;
    return frameCost(spec, scene)[FramePart::volume];
  };
  EXPECT_NEAR(volumeCost(1, 64, 1) * 1e-9, 0.5, 0.3) << "seconds; 0.8 s, 19 s were measured for frames of 1 and 6";
  EXPECT_NEAR(volumeCost(6, 64, 1) * 1e-9, 19, 5);
  EXPECT_DOUBLE_EQ(volumeCost(2, 64, 3), 3 * volumeCost(2, 64, 1));
  EXPECT_GT(volumeCost(16, 64, 1) * 1e-9, 4 * 20) << "refused where a request has 20 s";
  EXPECT_GT(volumeCost(1, 32, 1), 4 * volumeCost(1, 16, 1));
  EXPECT_GT(volumeCost(1, 256, 1), 3 * volumeCost(1, 64, 1)) << "longer ways to as many points";
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
  summary.volumeFiles = {"a.npy", "b.npy"};
  summary.memory.volumes = 2 * 4 * 64 * 64 * 64;
  const SceneCounts counts = sceneCounts(summary);
  EXPECT_DOUBLE_EQ(counts.voxels, 64 * 64 * 64) << "of a file";
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
