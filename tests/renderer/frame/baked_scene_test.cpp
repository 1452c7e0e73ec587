#include "renderer/frame/baked_scene.h"

#include <atomic>
#include <gtest/gtest.h>
#include <thread>

#include "renderer/frame/render_frame.h"
#include "tests/renderer/frame/squares.h"

namespace gnomon {
namespace {

FrameSpec lightMapSpec(int size, int samples = 64) {
  FrameSpec made;
  Light sun;
  sun.sun = Sun{90, 50};
  sun.angularDiameterDegrees = 2;
  made.lights = std::vector{sun};
  made.shadow.technique = ShadowTechnique::lightMap;
  made.shadow.lightMap.size = size;
  made.shadow.lightMap.samples = samples;
  return made;
}

class BakeScene : public ::testing::Test {
 protected:
  Result<BakeReport> bake(const FrameSpec& asked, const BakeListener& listener = {}) {
    const auto baked = bakeScene(caches_, scene_, asked, listener);
    if (!baked) return baked.problems();
    return reportOf(*baked);
  }

  const ScenePtr scene_ = testing::squares();
  FrameCaches caches_{TracedSceneCache(1 << 20), LightMapCache(1u << 28), VolumeCache(1u << 28)};
};

TEST_F(BakeScene, N5_IsReusedByWhatAsksForTheSame) {
  const auto first = bake(lightMapSpec(64));
  ASSERT_TRUE(first) << first.problems().front().detail;
  ASSERT_EQ(first->lights.size(), 1u);
  EXPECT_FALSE(first->lights[0].lightMap.reused);
  EXPECT_GT(first->lights[0].lightMap.bytes, 0u);
  EXPECT_TRUE(bake(lightMapSpec(64))->lights[0].lightMap.reused);
  EXPECT_FALSE(bake(lightMapSpec(65))->lights[0].lightMap.reused);
  FrameSpec moved = lightMapSpec(64);
  moved.lights->front().sun->azimuthDegrees = 91;
  EXPECT_FALSE(bake(moved)->lights[0].lightMap.reused);
}

TEST_F(BakeScene, TellsProgressOfEachLightInTurn) {
  FrameSpec two = lightMapSpec(64);
  two.lights->push_back(two.lights->front());
  two.lights->back().sun->azimuthDegrees = 200;
  two.lights->insert(two.lights->begin(), Light{});
  two.lights->front().shadow = Shadow{};
  two.lights->front().shadow->technique = ShadowTechnique::rayTraced;
  std::vector<BakeStep> steps;
  const auto report = bake(two, [&](const BakeStep& step) {
    steps.push_back(step);
    return true;
  });
  ASSERT_TRUE(report) << report.problems().front().detail;
  ASSERT_EQ(report->lights.size(), 2u) << "the light that is traced in each frame is not baked";
  ASSERT_GE(steps.size(), 2u);
  EXPECT_EQ(steps.front().light, 1);
  EXPECT_EQ(steps.back().light, 2);
  EXPECT_EQ(steps.back().share, 1);
  for (const BakeStep& step : steps) {
    EXPECT_EQ(step.done, step.light.value() - 1);
    EXPECT_EQ(step.of, 2);
  }
}

TEST_F(BakeScene, TheEnvironmentIsBakedAfterTheLightsAndReused) {
  FrameSpec asked = lightMapSpec(64);
  EXPECT_FALSE(bake(asked)->environment) << "no rays to it are asked for";
  asked.environment.shadows = EnvironmentShadows::rays;
  asked.environment.sky = Sky{};
  asked.environment.extractSun = SunExtraction::removed;
  std::vector<BakeStep> steps;
  const auto first = bake(asked, [&](const BakeStep& step) {
    steps.push_back(step);
    return true;
  });
  ASSERT_TRUE(first) << first.problems().front().detail;
  ASSERT_TRUE(first->environment);
  EXPECT_FALSE(first->environment->reused);
  EXPECT_EQ(first->environment->width, first->lights[0].lightMap.width);
  EXPECT_GT(first->environment->bytes, 0u);
  ASSERT_FALSE(steps.empty());
  EXPECT_EQ(steps.back().light, std::nullopt);
  EXPECT_EQ(steps.back().share, 1);
  EXPECT_EQ(steps.back().done, 1);
  EXPECT_EQ(steps.back().of, 2);

  FrameSpec same = asked;
  same.environment.intensity = 1e-4;
  same.ambient.intensity = 2;
  EXPECT_TRUE(bake(same)->environment->reused);
  same.lights->clear();
  const auto alone = bake(same);
  ASSERT_TRUE(alone) << alone.problems().front().detail;
  EXPECT_TRUE(alone->lights.empty());
  EXPECT_TRUE(alone->environment->reused);
  FrameSpec finer = asked;
  finer.environment.samples = 2;
  EXPECT_FALSE(bake(finer)->environment->reused);
  FrameSpec turned = asked;
  turned.environment.rotationDegrees = 30;
  EXPECT_FALSE(bake(turned)->environment->reused);
  same.shadow.lightMap.texelsPerMetre = 1e6;
  EXPECT_EQ(bake(same).problems().front().pointer, "/shadow/lightMap/texelsPerMetre");
}

TEST_F(BakeScene, StopsSoonAndLeavesNothingBehind) {
  const FrameSpec slow = lightMapSpec(4096, 1024);
  using Clock = std::chrono::steady_clock;
  std::optional<Clock::time_point> asked;
  const auto report = bake(slow, [&](const BakeStep& step) {
    if (step.share == 0 && !asked) return true;
    asked = asked.value_or(Clock::now());
    return false;
  });
  const auto took = Clock::now() - *asked;
  ASSERT_FALSE(report);
  EXPECT_EQ(report.problems().front().code, ProblemCode::unavailable);
  EXPECT_LT(took, std::chrono::milliseconds(500)) << "all of it would take minutes";
  EXPECT_FALSE(bake(lightMapSpec(64))->lights[0].lightMap.reused);
}

TEST_F(BakeScene, WhoWantsTheSameWaitsAndOthersDoNot) {
  const FrameSpec slow = lightMapSpec(4096, 1024);
  std::atomic<bool> begun = false, stop = false;
  std::thread baking([&] {
    const auto stopped = bake(slow, [&](const BakeStep&) {
      begun = true;
      return !stop.load();
    });
    EXPECT_FALSE(stopped);
  });
  while (!begun) std::this_thread::yield();
  EXPECT_TRUE(bake(lightMapSpec(32))) << "beside it";
  int asked = 0;
  const auto same = bake(slow, [&](const BakeStep&) { return ++asked < 3; });
  EXPECT_FALSE(same) << "it may be stopped while it waits";
  stop = true;
  baking.join();
}

TEST_F(BakeScene, WhatCanNotBeBakedIsAProblem) {
  FrameSpec traced = lightMapSpec(64);
  traced.shadow.technique = ShadowTechnique::rayTraced;
  EXPECT_EQ(bake(traced).problems().front().pointer, "/shadow/technique");
  FrameSpec dense = lightMapSpec(64);
  dense.shadow.lightMap.texelsPerMetre = 1e6;
  EXPECT_EQ(bake(dense).problems().front().pointer, "/shadow/lightMap/texelsPerMetre");
}

} // namespace
} // namespace gnomon
