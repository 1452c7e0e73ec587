#include "renderer/device/shader_data.h"

#include <gtest/gtest.h>

namespace gnomon {
namespace {

TEST(LightData, ALightIsPackedByName) {
  LitLight sun;
  sun.direction = {0, -1, 0};
  sun.strength = 0.5;
  sun.firstTile = 2;
  sun.tileCount = 3;
  sun.filter = kernelOf({FilterType::pcf, 5});
  sun.fadesOut = true;
  sun.groups = {5u, 4u};
  LitLight lamp;
  lamp.type = LightType::point;
  lamp.position = {0, 1, 2};
  lamp.visibilityLayer = 1;
  const std::vector<LitLight> lights{lamp, sun};
  const auto data = lightData(lights);
  ASSERT_EQ(data.size(), 2u);
  EXPECT_EQ(data[0].tileCount, 0u);
  EXPECT_EQ(data[0].visibilityLayer, 2u) << "counted from 1";
  EXPECT_EQ(data[0].position, glm::vec3(0, 1, 2));
  EXPECT_EQ(data[0].range, 0.0f) << "no range is infinite";
  EXPECT_EQ(data[1].direction, glm::vec3(0, 1, 0)) << "towards the light";
  EXPECT_EQ(data[1].firstTile, 2u);
  EXPECT_EQ(data[1].tileCount, 3u);
  EXPECT_EQ(data[1].filterSize, 5);
  EXPECT_EQ(data[1].visibilityLayer, 0u);
  EXPECT_EQ(data[1].strength, 0.5f);
  EXPECT_EQ(data[1].fadesOut, 1u);
  EXPECT_EQ(data[1].litGroups, 5u);
  EXPECT_EQ(data[1].shadowedGroups, 4u);
}

TEST(LightData, M14_TheReceiverUsesTheMatrixThatTheMapWasDrawnWith) {
  ShadowPlan plan;
  plan.atlasWidth = 256;
  plan.atlasHeight = 128;
  ShadowTile tile;
  tile.rect = {64, 32, 64, 32};
  tile.border = 4;
  tile.clipFromRelative = glm::dmat4(glm::dvec4(0.5, 0, 0, 0), glm::dvec4(0, 0.25, 0, 0), glm::dvec4(0, 0, 0.125, 0),
                                     glm::dvec4(0.5, -0.5, 0.25, 1));
  plan.tiles.push_back(tile);
  plan.lights.push_back({.light = 2, .firstTile = 0, .tileCount = 1, .note = ""});
  const shared::TileData data = tileData(plan).at(0);
  const glm::vec4 p(1, 1, 2, 1);
  const glm::dvec4 clip = tile.clipFromRelative * glm::dvec4(p);
  EXPECT_FLOAT_EQ(glm::dot(data.atlasFromRelative[0], p), static_cast<float>((64 + (clip.x * 0.5 + 0.5) * 64) / 256));
  EXPECT_FLOAT_EQ(glm::dot(data.atlasFromRelative[1], p), static_cast<float>((32 + (clip.y * 0.5 + 0.5) * 32) / 128));
  EXPECT_FLOAT_EQ(glm::dot(data.atlasFromRelative[2], p), static_cast<float>(clip.z));
  EXPECT_EQ(data.lowest, glm::vec2(67.0f / 256, 35.0f / 128)) << "room for the filter";
  EXPECT_EQ(data.highest, glm::vec2(125.0f / 256, 61.0f / 128));
}

TEST(LightData, ATileWithoutTexelsHoldsNoLookup) {
  ShadowPlan plan;
  plan.atlasWidth = plan.atlasHeight = 64;
  plan.tiles.push_back({});
  plan.lights.push_back({.light = 0, .firstTile = 0, .tileCount = 1, .note = ""});
  const shared::TileData data = tileData(plan)[0];
  EXPECT_GT(data.lowest.x, data.highest.x);
}

} // namespace
} // namespace gnomon
