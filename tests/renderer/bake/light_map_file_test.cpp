#include "renderer/bake/light_map_file.h"

#include <gtest/gtest.h>

namespace gnomon {
namespace {

BakedLight baked() {
  LightMapLayout layout;
  layout.width = 3;
  layout.height = 2;
  layout.firstCorner = {0};
  layout.corners = {{0, 0}, {3, 0}, {0, 2}};
  return {std::make_shared<const LightMapLayout>(layout), {3, 2, {0, 1, 255, 256, 40000, 65535}}, 12.5};
}

TEST(LightMapFile, ReadsBackWhatWasWritten) {
  const BakedLight original = baked();
  const auto read = readLightMapFile(lightMapFile(original), original.layout);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->map.shares, original.map.shares);
  EXPECT_EQ(read->map.width, 3);
  EXPECT_EQ(read->map.height, 2);
  EXPECT_EQ(read->milliseconds, 12.5);
}

TEST(LightMapFile, AnEnvironmentHasThreePlanes) {
  BakedLight original = baked();
  original.greenAndBlue = {LightMap{3, 2, {6, 5, 4, 3, 2, 1}}, LightMap{3, 2, {9, 99, 999, 9999, 0, 65535}}};
  const Bytes file = lightMapFile(original);
  const auto read = readLightMapFile(file, original.layout, BakedPlanes::rgb);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->map.shares, original.map.shares);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(read->greenAndBlue[i].shares, original.greenAndBlue[i].shares);
  EXPECT_FALSE(readLightMapFile(file, original.layout));
  EXPECT_FALSE(readLightMapFile(lightMapFile(baked()), original.layout, BakedPlanes::rgb));
}

TEST(LightMapFile, AnyByteThatDiffersIsNoticed) {
  const BakedLight original = baked();
  const Bytes file = lightMapFile(original);
  for (std::size_t i = 0; i < file.size(); ++i) {
    Bytes changed = file;
    changed[i] ^= 1;
    EXPECT_FALSE(readLightMapFile(changed, original.layout)) << i;
    EXPECT_FALSE(readLightMapFile(std::span(file).first(i), original.layout)) << i;
  }
  Bytes longer = file;
  longer.push_back(0);
  EXPECT_FALSE(readLightMapFile(longer, original.layout));
}

TEST(LightMapFile, IsOfItsLayoutAlone) {
  const Bytes file = lightMapFile(baked());
  LightMapLayout moved = *baked().layout;
  moved.corners[1].x = 2.5f;
  EXPECT_FALSE(readLightMapFile(file, std::make_shared<const LightMapLayout>(moved)));
  LightMapLayout turned = *baked().layout;
  std::swap(turned.width, turned.height);
  EXPECT_FALSE(readLightMapFile(file, std::make_shared<const LightMapLayout>(turned)));
}

} // namespace
} // namespace gnomon
