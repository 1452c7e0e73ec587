// Only what the scene needs is done: what adds nothing to a picture adds no tile, no draw call and no triangle.
#include "protocol/json/json_codec.h"
#include "tests/renderer/frame_fixture.h"

namespace gnomon {
namespace {

using testing::renderJson;

/// A ground of 20 x 20 m, a square caster above it, and another square where `aside` says.
ScenePtr groundAndCaster(const std::optional<testing::Point>& aside) {
  testing::GlbBuilder builder = testing::plane();
  builder.json["nodes"][0]["scale"] = {10, 10, 10};
  builder.addRoot({{"mesh", 0}, {"translation", {0, 2, 0}}});
  if (aside) builder.addRoot({{"mesh", 0}, {"translation", *aside}});
  return testing::sceneOf(builder);
}

/// From 8 m above the ground's edge towards its middle, so that its sides are out of view.
Json groundSpec() {
  return Json::parse(R"({"width":96,"height":64,"camera":{"eye":[0,8,9],"target":[0,0,0]},
      "lights":[{"type":"directional","direction":[0.2,-1,0.1]}],"shadow":{"cascadeCount":2}})");
}

void expectSameCost(const FrameReport& with, const FrameReport& without) {
  EXPECT_EQ(with.atlasSize, without.atlasSize);
  EXPECT_EQ(with.counts.casterTriangles, without.counts.casterTriangles);
  EXPECT_EQ(with.counts.surveyedTriangles, without.counts.surveyedTriangles);
  EXPECT_EQ(with.counts.shadedTriangles, without.counts.shadedTriangles);
  EXPECT_EQ(with.counts.drawCalls, without.counts.drawCalls);
  EXPECT_EQ(with.passes.size(), without.passes.size());
}

void expectNothingDone(const LightReport& light, const std::string& why) {
  EXPECT_FALSE(light.shadowed);
  EXPECT_NE(light.note.find(why), std::string::npos) << light.note;
  EXPECT_TRUE(light.tiles.empty());
  EXPECT_EQ(light.drawCalls, 0u);
  EXPECT_EQ(light.casterTriangles, 0u);
  EXPECT_FALSE(light.cpuMilliseconds);
  EXPECT_FALSE(light.predictedError);
}

struct IdleLight {
  const char* light;
  const char* why; ///< part of its note
};

/// Each light, added to the frame, is reported and costs nothing.
void expectIdle(std::initializer_list<IdleLight> lights) {
  const ScenePtr scene = groundAndCaster({});
  const Frame without = renderJson(scene, groundSpec().dump());
  ASSERT_GT(without.report.counts.casterTriangles, 0u);
  for (const auto& [light, why] : lights) {
    Json spec = groundSpec();
    spec["lights"].push_back(Json::parse(light));
    const Frame with = renderJson(scene, spec.dump());
    ASSERT_EQ(with.report.lights.size(), 2u) << light;
    expectSameCost(with.report, without.report);
    expectNothingDone(with.report.lights[1], why);
  }
}

TEST(FrameCounts, X6_X7_ALightThatReachesNoVisibleReceiverCostsNothing) {
  expectIdle(
      {{R"({"type":"point","position":[0,3,500],"range":5})", "out of view"},
       {R"({"type":"spot","position":[0,3,-700],"direction":[0,0,-1],"range":9,"outerConeDegrees":30})", "out of view"},
       {R"({"type":"point","position":[0,4,0],"range":0.5})", "reaches nothing"},
       {R"({"type":"spot","position":[0,3,0],"direction":[0,1,0],"outerConeDegrees":30})", "reaches nothing"}});
}

TEST(FrameCounts, X2_ASwitchedOffLightCostsNothing) {
  expectIdle({{R"({"type":"directional","direction":[1,-1,0],"shadow":{"enabled":false}})", "is disabled"},
              {R"({"type":"directional","direction":[1,-1,0],"shadow":{"strength":0}})", "strength is 0"},
              {R"({"type":"point","position":[0,4,0],"intensity":0})", "intensity is 0"}});
}

TEST(FrameCounts, X18_AnEmptyCascadeCostsNothing) {
  testing::GlbBuilder builder = testing::plane();
  builder.json["nodes"][0]["translation"] = {0, 0, -8};
  builder.addRoot({{"mesh", 0}, {"translation", {0, 0, -100}}, {"scale", {20, 1, 20}}});
  const ScenePtr scene = testing::sceneOf(builder);
  Json spec = Json::parse(R"({"width":96,"height":64,"camera":{"eye":[0,4,4],"target":[0,0,-20]},
      "lights":[{"type":"directional","direction":[0.2,-1,0.1]}],
      "shadow":{"cascadeCount":2,"blendCascades":false,"partition":{"mode":"manual","splits":[0.3,1]}}})");
  const Frame without = renderJson(scene, spec.dump());
  spec["shadow"]["cascadeCount"] = 3;
  spec["shadow"]["partition"]["splits"] = {0.3, 0.5, 1};
  const Frame with = renderJson(scene, spec.dump());
  expectSameCost(with.report, without.report);
  ASSERT_EQ(with.report.lights[0].tiles.size(), 3u);
  const TileReport& empty = with.report.lights[0].tiles[1];
  EXPECT_EQ(empty.tile, (std::array<int, 4>{}));
  EXPECT_EQ(empty.drawCalls, 0u);
  EXPECT_EQ(empty.casterTriangles, 0u);
  EXPECT_FALSE(empty.matrix);
  EXPECT_FALSE(empty.cpuMilliseconds);
  EXPECT_NE(with.report.lights[0].note.find("not drawn"), std::string::npos) << with.report.lights[0].note;
}

TEST(FrameCounts, M14_X26_ACasterThatShadowsNothingInViewCostsNothing) {
  const Frame without = renderJson(groundAndCaster({}), groundSpec().dump());
  const testing::Point places[] = {{0, 2, 300}, {-400, 5, 0}, {0, -3, 0}};
  for (const testing::Point& place : places) {
    const Frame with = renderJson(groundAndCaster(place), groundSpec().dump());
    EXPECT_EQ(with.report.atlasSize, without.report.atlasSize);
    EXPECT_EQ(with.report.counts.sceneTriangles, without.report.counts.sceneTriangles + 2);
    EXPECT_EQ(with.report.counts.casterTriangles, without.report.counts.casterTriangles) << place[2];
    ASSERT_EQ(with.report.lights[0].tiles.size(), without.report.lights[0].tiles.size());
    for (std::size_t i = 0; i < with.report.lights[0].tiles.size(); ++i) {
      const TileReport& more = with.report.lights[0].tiles[i];
      const TileReport& less = without.report.lights[0].tiles[i];
      EXPECT_EQ(more.drawCalls, less.drawCalls);
      EXPECT_EQ(more.casterTriangles, less.casterTriangles);
      EXPECT_EQ(more.culledTriangles, less.culledTriangles + 2);
    }
  }
}

TEST(FrameCounts, X26_ACasterOutOfViewCostsOnlyTheTilesThatItShadows) {
  // Beside the view, but between the sun and what is seen.
  const Frame with = renderJson(groundAndCaster(testing::Point{-6, 30, -3}), groundSpec().dump());
  const Frame without = renderJson(groundAndCaster({}), groundSpec().dump());
  EXPECT_EQ(with.report.counts.surveyedTriangles, without.report.counts.surveyedTriangles);
  EXPECT_GT(with.report.counts.casterTriangles, without.report.counts.casterTriangles);
}

} // namespace
} // namespace gnomon
