#include "renderer/prepare/outlines.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <thread>
#include <unistd.h>

#include "tests/support/cpu_grant.h"

namespace gnomon {
namespace {

/// Outlines of so many instances that every thread that may help has the time to start.
void outlineMany() {
  const Scene scene;
  SceneView view;
  view.instances.resize(200'000);
  const FrameGeometry geometry;
  const Light light;
  outlinesOf({.scene = scene, .view = view, .geometry = geometry, .meshes = {}, .light = light}, {});
}

TEST(OutlinesDeathTest, UseAsManyThreadsAsTheControlGroupGrants) {
  if (!canGrantCores()) GTEST_SKIP() << "control groups can't be replaced here";
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const auto threadsWith = [](int cores) {
    grantCores(cores);
    outlineMany();
    _exit(threadCount());
  };
  EXPECT_EXIT(threadsWith(1), testing::ExitedWithCode(1), "");
  const int machine = static_cast<int>(std::thread::hardware_concurrency());
  EXPECT_EXIT(threadsWith(2), testing::ExitedWithCode(std::min(2, machine)), "");
}

} // namespace
} // namespace gnomon
