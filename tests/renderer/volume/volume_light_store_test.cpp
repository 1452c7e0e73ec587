#include <gtest/gtest.h>

#include "renderer/core/stop.h"
#include "renderer/volume/volume_light.h"
#include "tests/renderer/volume/media.h"

namespace gnomon {
namespace {

constexpr std::size_t kTexelBytes = 16;

/// Asks for the map of one medium again and again, each time with something else changed.
struct Asking {
  VolumeLightStore store{1u << 20};
  Medium medium = homogeneous(boxSpace({0, 0, 0}, {1, 1, 1}), 1);
  VolumeLightInput input{.towards = glm::dvec3(0, 1, 0), .size = {2, 2, 2}};
  std::string lights = "sun", casters = "house";

  bool makes() {
    const Medium* media[]{&medium};
    input.media = media;
    return store.mapOf(VolumeLightKey(input, lights, casters), [&] { return makeVolumeLight(input); }).made;
  }
};

TEST(VolumeLightStore, D5_AMapIsMadeAnewOnlyWhenVolumeLightOrCastersChange) {
  Asking asking;
  EXPECT_TRUE(asking.makes());
  EXPECT_FALSE(asking.makes());
  const std::vector<std::function<void()>> changes{
      [&] { asking.medium.function = proportional(2); },
      [&] {
        asking.medium.space = boxSpace({0, 0, 0}, {1, 1, 2});
      },
      [&] { asking.medium.grid = std::make_shared<DensityGrid>(*asking.medium.grid); },
      [&] { asking.medium.castShadow = false; },
      [&] { asking.medium.receiveShadow = false; },
      [&] { asking.input.towards = glm::dvec3(1, 0, 0); },
      [&] { asking.input.towards.reset(); },
      [&] {
        asking.input.size = {2, 3, 2};
      },
      [&] { asking.lights = "sunset"; },
      [&] { asking.casters = "tree"; }};
  for (std::size_t i = 0; i < changes.size(); ++i) {
    changes[i]();
    EXPECT_TRUE(asking.makes()) << i;
    EXPECT_FALSE(asking.makes()) << i;
  }
}

TEST(VolumeLightStore, AnotherVolumesMapIsAnother) {
  VolumeLightStore store(1u << 20);
  const Medium a = homogeneous(boxSpace({0, 0, 0}, {1, 1, 1}), 1), b = homogeneous(boxSpace({0, 2, 0}, {1, 3, 1}), 1);
  const Medium* both[]{&a, &b};
  const Medium* one[]{&a};
  VolumeLightInput input{.media = both, .towards = glm::dvec3(0, 1, 0), .size = {2, 2, 2}};
  const auto makes = [&] {
    return store.mapOf(VolumeLightKey(input, "", ""), [&] { return makeVolumeLight(input); }).made;
  };
  EXPECT_TRUE(makes());
  input.chosen = 1;
  EXPECT_TRUE(makes());
  input.chosen = 0;
  EXPECT_FALSE(makes());
  input.media = one;
  EXPECT_TRUE(makes());
}

TEST(VolumeLightStore, TheLatestUsedAreKeptWithinTheBound) {
  Asking asking;
  asking.store = VolumeLightStore(2 * 8 * kTexelBytes);
  for (const char* lights : {"a", "b", "a", "c"}) {
    asking.lights = lights;
    asking.makes();
  }
  asking.lights = "a";
  EXPECT_FALSE(asking.makes());
  asking.lights = "b";
  EXPECT_TRUE(asking.makes());
  // One that is larger than all may be is given, and not kept.
  asking.input.size = {4, 4, 4};
  EXPECT_TRUE(asking.makes());
  EXPECT_TRUE(asking.makes());
}

TEST(VolumeLightStore, WhatWasFinishedWhenAFrameIsStoppedIsKept) { // F11
  Asking asking;
  asking.lights = "first volume";
  EXPECT_TRUE(asking.makes());
  const Medium* media[]{&asking.medium};
  asking.input.media = media;
  const auto stopped = [&] {
    asking.store.mapOf(VolumeLightKey(asking.input, "second volume", "house"),
                       []() -> VolumeLight { throw Stopped{}; });
  };
  EXPECT_THROW(stopped(), Stopped);
  EXPECT_FALSE(asking.makes()) << "so that the same frame goes further the next time";
  asking.lights = "second volume";
  EXPECT_TRUE(asking.makes());
}

TEST(VolumeLightStore, AMapKeepsNoGridAlive) {
  Asking asking;
  asking.makes();
  const std::weak_ptr<const DensityGrid> grid = asking.medium.grid;
  asking.medium.grid.reset();
  EXPECT_TRUE(grid.expired());
}

} // namespace
} // namespace gnomon
