// A frame that knows that its picture lacks something says so: one case, and one beside it that must stay silent, a
// rule.
#include <gmock/gmock.h>

#include "tests/renderer/frame_fixture.h"

namespace gnomon {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::renderJson;
using testing::sceneOf;

/// A square of `side` metres on the ground, its front above.
void addGround(testing::GlbBuilder& builder, float side, const Json& material = {}) {
  const float end = side / 2;
  const int position = builder.addPoints({{-end, 0, end}, {end, 0, end}, {end, 0, -end}, {-end, 0, -end}});
  Json primitive = {{"attributes", {{"POSITION", position}}}, {"indices", builder.addShortIndices({0, 1, 2, 0, 2, 3})}};
  if (!material.is_null()) primitive["material"] = builder.add("materials", material);
  builder.addMeshNode(builder.addMesh(std::move(primitive)));
}

/// An upright square of 2 m in the middle of the ground, its front to the south (+z).
void addWall(testing::GlbBuilder& builder, const Json& material = {}) {
  const int position = builder.addPoints({{-1, 0, 0}, {1, 0, 0}, {1, 2, 0}, {-1, 2, 0}});
  Json primitive = {{"attributes", {{"POSITION", position}}}, {"indices", builder.addShortIndices({0, 1, 2, 0, 2, 3})}};
  if (!material.is_null()) primitive["material"] = builder.add("materials", material);
  builder.json["nodes"][static_cast<std::size_t>(builder.addMeshNode(builder.addMesh(std::move(primitive))))]["name"] =
      "Wall";
}

ScenePtr wallOnGround(float side = 10) {
  testing::GlbBuilder builder;
  addGround(builder, side);
  addWall(builder);
  return sceneOf(builder);
}

Json specFrom(const Json& camera, const Json& more = Json::object()) {
  Json spec = {{"width", 96},
               {"height", 96},
               {"antialiasing", "none"},
               {"camera", camera},
               {"lights", {{{"sun", {{"azimuthDegrees", 180}, {"elevationDegrees", 45}}}}}}};
  spec.merge_patch(more);
  return spec;
}

Json lookAt(const Json& eye, const Json& target = {0, 1, 0}) {
  return {{"eye", eye}, {"target", target}};
}

std::vector<std::string> warningsOf(const ScenePtr& scene, const Json& spec) {
  return renderJson(scene, spec.dump()).report.warnings;
}

const Json kFront = lookAt({0, 2, 6});

TEST(FrameWarnings, AnOrdinaryFrameHasNone) {
  EXPECT_THAT(warningsOf(wallOnGround(), specFrom(kFront)), IsEmpty());
}

TEST(FrameWarnings, EverythingOutsideOfThePictureIsToldWithItsNumber) {
  EXPECT_THAT(warningsOf(wallOnGround(), specFrom(lookAt({0, 2, 6}, {0, 3, 20}))),
              Contains(AllOf(HasSubstr("shows nothing"), HasSubstr("all 2 surfaces"))));
}

TEST(FrameWarnings, AHiddenSurfaceIsNotOneThatLiesOutside) {
  const Json hidden = {{"nodes", {{{"node", 0}, {"visible", false}}, {{"node", 1}, {"visible", false}}}}};
  EXPECT_THAT(warningsOf(wallOnGround(), specFrom(lookAt({0, 2, 6}, {0, 3, 20}), hidden)), IsEmpty());
}

TEST(FrameWarnings, ANearPlaneThatCutsAWallSaysFromWhereOn) {
  Json camera = kFront;
  camera["perspective"] = {{"near", 6.5}};
  EXPECT_THAT(warningsOf(wallOnGround(), specFrom(camera)),
              Contains(AllOf(HasSubstr("near plane at 6.5 m"), HasSubstr("in view"), HasSubstr("Lower near"))));
}

TEST(FrameWarnings, ANearPlaneBeforeAllThatIsInViewCutsNothing) {
  Json camera = lookAt({0, 2, 6}, {0, 2, 0}); // the ground begins beyond the lower side of the picture
  camera["perspective"] = {{"near", 1.0}};
  EXPECT_THAT(warningsOf(wallOnGround(), specFrom(camera)), IsEmpty());
}

TEST(FrameWarnings, AnOrthographicNearPlaneCutsToo) {
  Json camera = kFront;
  camera["orthographic"] = {{"height", 4}, {"near", 7}, {"far", 100}};
  EXPECT_THAT(warningsOf(wallOnGround(), specFrom(camera)), Contains(HasSubstr("camera.orthographic.near")));
}

TEST(FrameWarnings, ASingleSidedSurfaceSeenFromBehindIsNamed) {
  EXPECT_THAT(
      warningsOf(wallOnGround(), specFrom(lookAt({0, 2, -6}))),
      Contains(AllOf(HasSubstr("A single-sided surface"), HasSubstr("node 1 \"Wall\""), HasSubstr("doubleSided"))));
}

TEST(FrameWarnings, ADoubleSidedSurfaceIsSeenFromBehind) {
  testing::GlbBuilder builder;
  addGround(builder, 10);
  addWall(builder, {{"doubleSided", true}});
  EXPECT_THAT(warningsOf(sceneOf(builder), specFrom(lookAt({0, 2, -6}))), IsEmpty());
}

TEST(FrameWarnings, ABackThatOtherSurfacesCoverIsNoLoss) {
  testing::GlbBuilder builder;
  addGround(builder, 10);
  addWall(builder);
  const int position = builder.addPoints({{-2, 0, -1}, {-2, 3, -1}, {2, 3, -1}, {2, 0, -1}});
  builder.addMeshNode(builder.addMesh(
      {{"attributes", {{"POSITION", position}}}, {"indices", builder.addShortIndices({0, 1, 2, 0, 2, 3})}}));
  EXPECT_THAT(warningsOf(sceneOf(builder), specFrom(lookAt({0, 2, -6}))), IsEmpty());
}

TEST(FrameWarnings, AMirroredNodeShowsItsOtherSide) {
  testing::GlbBuilder builder;
  addGround(builder, 10);
  addWall(builder);
  builder.json["nodes"][1]["scale"] = {-1, 1, 1};
  const ScenePtr scene = sceneOf(builder);
  EXPECT_THAT(warningsOf(scene, specFrom(kFront)), IsEmpty());
}

/// A ground to the horizon, seen from a man's height, with one cascade of few texels.
Json coarseSpec(const Json& shadow) {
  return specFrom(lookAt({0, 1.7, 6}, {0, 1, 0}), {{"shadow", shadow}, {"atlas", {{"baseSize", 128}}}});
}

TEST(FrameWarnings, TexelsOfAShadowMapThatAreCoarserThan16Pixels) {
  const Json one = {{"cascadeCount", 1}, {"size", "XSmall"}};
  EXPECT_THAT(warningsOf(wallOnGround(5000), coarseSpec(one)),
              Contains(AllOf(HasSubstr("Light 0's shadow is coarse"), HasSubstr("pixels"), HasSubstr("cascadeCount"))));
}

TEST(FrameWarnings, RaysHaveNoTexelsThatAreCoarse) {
  const Json rays = {{"technique", "rayTraced"}, {"cascadeCount", 1}, {"size", "XSmall"}};
  EXPECT_THAT(warningsOf(wallOnGround(5000), coarseSpec(rays)), IsEmpty());
}

TEST(FrameWarnings, ADepthRangeThatHoldsNothingInView) {
  const Json range = {{"depthRange", {{"mode", "manual"}, {"min", 500}, {"max", 600}}}};
  EXPECT_THAT(warningsOf(wallOnGround(), specFrom(kFront, {{"shadow", range}})),
              Contains(AllOf(HasSubstr("Light 0 casts no shadow"), HasSubstr("shadow.depthRange"))));
}

TEST(FrameWarnings, AnAtlasWithoutRoomForALight) {
  Json lights = Json::array();
  for (int i = 0; i < 12; ++i) {
    lights.push_back({{"type", "point"}, {"position", {i % 4 - 1.5, 2.5, 1.0 + i / 4}}, {"range", 20}});
  }
  const Json full = {{"lights", lights}, {"atlas", {{"size", 128}, {"baseSize", 128}}}};
  EXPECT_THAT(warningsOf(wallOnGround(), specFrom(kFront, full)),
              Contains(AllOf(HasSubstr("casts no shadow: the atlas has no room"), HasSubstr("atlas.size"))));
}

TEST(FrameWarnings, ALightMapThatIsCoarserThan8Pixels) {
  const Json map = {{"shadow", {{"technique", "lightMap"}, {"lightMap", {{"texelsPerMetre", 0.5}}}}}};
  EXPECT_THAT(warningsOf(wallOnGround(), specFrom(kFront, map)),
              Contains(AllOf(HasSubstr("Light 0's light map is coarse"), HasSubstr("texels of 2 m"))));
  const Json fine = {{"shadow", {{"technique", "lightMap"}, {"lightMap", {{"texelsPerMetre", 20}}}}}};
  EXPECT_THAT(warningsOf(wallOnGround(), specFrom(kFront, fine)), IsEmpty());
}

TEST(FrameWarnings, WhatTheFileSaysStandsBeforeWhatThePictureLacks) {
  testing::GlbBuilder builder;
  addGround(builder, 10);
  builder.json["materials"][0] = {{"extensions", {{"KHR_materials_iridescence", Json::object()}}}};
  builder.json["meshes"][0]["primitives"][0]["material"] = 0;
  builder.json["extensionsUsed"] = {"KHR_materials_iridescence"};
  const ScenePtr scene = sceneOf(builder);
  ASSERT_FALSE(scene->summary.warnings.empty());
  const auto warnings = warningsOf(scene, specFrom(lookAt({0, 2, 6}, {0, 3, 20})));
  ASSERT_GT(warnings.size(), scene->summary.warnings.size());
  EXPECT_EQ(warnings.front(), scene->summary.warnings.front());
  EXPECT_THAT(warnings.back(), HasSubstr("shows nothing"));
}

TEST(FrameWarnings, APlanWarnsOfWhatNeedsNoPicture) {
  const auto plan = [](const Json& spec) {
    const auto decoded = decodeFrameSpec(testing::withMaps(spec).dump());
    EXPECT_TRUE(decoded);
    const auto report = planFrame(wallOnGround(), *decoded, testing::sharedRenderer().info());
    EXPECT_TRUE(report);
    return report ? report->warnings : std::vector<std::string>{};
  };
  EXPECT_THAT(plan(specFrom(lookAt({0, 2, 6}, {0, 3, 20}))), Contains(HasSubstr("shows nothing")));
  EXPECT_THAT(plan(specFrom(kFront)), IsEmpty());
}

} // namespace
} // namespace gnomon
