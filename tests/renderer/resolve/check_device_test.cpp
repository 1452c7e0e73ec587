#include <gtest/gtest.h>

#include "renderer/resolve/check_frame.h"

namespace gnomon {
namespace {

TEST(CheckDevice, D4_X8_WhatTheDeviceLacksIsAProblemWithItsPlaceAndLimit) {
  FrameSpec spec;
  spec.atlas = {.size = 8192, .baseSize = 1024, .samples = 4};
  RendererInfo device;
  device.maxTextureSize = 8192;
  device.maxSamples = 4;
  EXPECT_TRUE(checkDevice(spec, device));
  device.maxTextureSize = 4096;
  device.maxSamples = 1;
  const Status refused = checkDevice(spec, device);
  ASSERT_FALSE(refused);
  ASSERT_EQ(refused.problems().size(), 2u);
  EXPECT_EQ(refused.problems()[0].pointer, "/atlas/samples");
  EXPECT_EQ(refused.problems()[0].limit, "at most 1");
  EXPECT_EQ(refused.problems()[1].pointer, "/atlas/size");
  EXPECT_EQ(refused.problems()[1].limit, "at most 4096");
  EXPECT_EQ(refused.problems()[1].actual, "8192");
}

TEST(CheckDevice, APictureIsNoLargerThanTheDevicesTextures) {
  FrameSpec spec;
  spec.width = 16384;
  spec.height = 2048;
  RendererInfo device;
  device.maxTextureSize = 16384;
  device.maxSamples = 4;
  EXPECT_TRUE(checkDevice(spec, device));
  device.maxTextureSize = 8192;
  const Status refused = checkDevice(spec, device);
  ASSERT_FALSE(refused);
  ASSERT_EQ(refused.problems().size(), 1u);
  EXPECT_EQ(refused.problems()[0].pointer, "/width");
  EXPECT_EQ(refused.problems()[0].limit, "at most 8192");
  EXPECT_EQ(refused.problems()[0].actual, "16384");
}

TEST(CheckDevice, AnAtlasIsAsLargeAsItsTilesSamplesAndMoments) {
  ShadowPlan plan;
  plan.atlasWidth = plan.atlasHeight = 8192;
  ShadowTile tile;
  tile.rect = {0, 0, 4096, 4096};
  plan.tiles.push_back(tile);
  EXPECT_TRUE(checkAtlas(plan, 1));
  EXPECT_FALSE(checkAtlas(plan, 4)) << "1 GiB";
  plan.tiles[0].filter = kernelOf({FilterType::msm});
  const Status refused = checkAtlas(plan, 1);
  ASSERT_FALSE(refused) << "1.25 GiB";
  EXPECT_EQ(refused.problems()[0].code, ProblemCode::tooLarge);
  plan.atlasHeight = 2048;
  EXPECT_TRUE(checkAtlas(plan, 1));
}

} // namespace
} // namespace gnomon
