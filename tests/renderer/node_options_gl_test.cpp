// What a frame's node switches and a light's culling mask do, seen in rendered frames.
#include "protocol/json/json_codec.h"
#include "tests/renderer/frame_fixture.h"
#include "tests/support/png_of.h"

namespace gnomon {
namespace {

using testing::floatsOf;
using testing::renderJson;
using testing::valueAt;

using Jsons = std::vector<Json>;

/// A ground of 20 m at y 0, node 0. A box of 1 m at y 2, node 1, below an empty node "crane", 2. A card of 0.4 m just
/// over the ground at x 2, node 3: in the box's shadow when light falls along (1, -1, 0).
ScenePtr stage() {
  testing::GlbBuilder builder = testing::cube(); // mesh 0
  const int position = builder.addPoints({{-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}});
  const int square = builder.addMesh(
      {{"attributes", {{"POSITION", position}}}, {"indices", builder.addShortIndices({0, 1, 2, 0, 2, 3})}});
  builder.json["nodes"][0] = {{"name", "ground"}, {"mesh", square}, {"scale", {10, 1, 10}}};
  builder.add("nodes", {{"name", "box"}, {"mesh", 0}, {"scale", {0.5, 0.5, 0.5}}});
  builder.addRoot({{"name", "crane"}, {"children", {1}}, {"translation", {0, 2, 0}}});
  builder.addRoot({{"name", "card"}, {"mesh", square}, {"scale", {0.2, 1, 0.2}}, {"translation", {2, 0.01, 0}}});
  return testing::sceneOf(builder);
}

const Json kSun = {{"type", "directional"}, {"direction", {1, -1, 0}}};

/// Seen from 12 m above: 9.94 m a side at the ground.
Json spec(const Jsons& lights, const Jsons& nodes, const std::vector<std::string>& views) {
  return {{"width", 128},
          {"height", 128},
          {"camera", {{"eye", {0, 12, 0}}, {"target", {0, 0, 0}}, {"up", {0, 0, -1}}}},
          {"lights", lights},
          {"shadow", {{"filter", {{"type", "hard"}}}}},
          {"nodes", nodes},
          {"antialiasing", "none"},
          {"ambient", {{"intensity", 0}}},
          {"views", views},
          {"output", {{"format", "exr"}, {"exrPixelType", "float"}}}};
}

Frame frameOf(const Jsons& lights, const Jsons& nodes, const std::vector<std::string>& views) {
  static const ScenePtr scene = stage();
  return renderJson(scene, spec(lights, nodes, views).dump());
}

// Places in the picture, as shares of it.
struct Place {
  double x = 0.5;
  double y = 0.5;
};
constexpr Place kOnBox{0.5, 0.5};
constexpr Place kOnCard{0.701, 0.5};
constexpr Place kInShadow{0.701, 0.535}; ///< on the ground, beside the card
constexpr Place kInTheSun{0.2, 0.2};

float at(const Frame& frame, const Place& place, std::size_t view = 0) {
  return valueAt(frame, place.x, place.y, view);
}

/// The red of a pixel of a color view.
float redAt(const Frame& frame, const Place& place) {
  const auto column = static_cast<std::size_t>(place.x * 128);
  const auto row = static_cast<std::size_t>(place.y * 128);
  return floatsOf(frame).at((row * 128 + column) * 3);
}

const Json kLightsOfEachType = Json::parse(R"([{"type":"directional","direction":[1,-1,0]},
    {"type":"spot","position":[-10,12,0],"direction":[1,-1,0],"outerConeDegrees":30,"intensity":400},
    {"type":"point","position":[-10,12,0],"intensity":400}])");

TEST(NodeOptions, D2_AllFourPairsOfSeenAndCastingWork) {
  for (const Json& light : kLightsOfEachType) {
    for (const bool visible : {false, true}) {
      for (const bool castShadow : {false, true}) {
        const Jsons nodes = {{{"node", "box"}, {"visible", visible}, {"castShadow", castShadow}}};
        const Frame frame = frameOf({light}, nodes, {"shadow", "depth"});
        EXPECT_EQ(at(frame, kInShadow), castShadow ? 0.0f : 1.0f) << light << Json(nodes);
        EXPECT_NEAR(at(frame, kOnBox, 1), visible ? 9.5f : 12.0f, 1e-3) << light << Json(nodes);
      }
    }
  }
}

TEST(NodeOptions, D2_AllFourPairsOfCastingAndReceivingWork) {
  for (const Json& light : kLightsOfEachType) {
    for (const bool castShadow : {false, true}) {
      for (const bool receiveShadow : {false, true}) {
        const Jsons nodes = {{{"node", "crane"}, {"castShadow", castShadow}},
                             {{"node", "card"}, {"receiveShadow", receiveShadow}}};
        const Frame frame = frameOf({light}, nodes, {"shadow"});
        EXPECT_EQ(at(frame, kOnCard), castShadow && receiveShadow ? 0.0f : 1.0f) << light << Json(nodes);
        EXPECT_EQ(at(frame, kInShadow), castShadow ? 0.0f : 1.0f) << light << Json(nodes) << "the ground receives";
      }
    }
  }
}

TEST(NodeOptions, D2_WhatReceivesNothingIsLitAsIfNothingCastOnIt) {
  const Frame open = frameOf({kSun}, {{{"node", "crane"}, {"castShadow", false}}}, {"color"});
  const Frame spared = frameOf({kSun}, {{{"node", "card"}, {"receiveShadow", false}}}, {"color"});
  EXPECT_GT(redAt(open, kOnCard), 0.1f);
  EXPECT_EQ(redAt(spared, kOnCard), redAt(open, kOnCard));
  EXPECT_EQ(redAt(spared, kInShadow), 0.0f);
}

TEST(NodeOptions, D2_WhatCastsNowhereIsNotDrawnIntoTiles) {
  const Frame both = frameOf({kSun}, {}, {"shadow"});
  const Frame one = frameOf({kSun}, {{{"node", "box"}, {"castShadow", false}}}, {"shadow"});
  const Frame none = frameOf({kSun},
                             {{{"node", "crane"}, {"castShadow", false}},
                              {{"node", 0}, {"castShadow", false}},
                              {{"node", 3}, {"castShadow", false}}},
                             {"shadow"});
  EXPECT_GT(both.report.counts.casterTriangles, one.report.counts.casterTriangles);
  EXPECT_EQ(none.report.counts.casterTriangles, 0u);
  EXPECT_EQ(both.report.counts.surveyedTriangles, none.report.counts.surveyedTriangles)
      << "the eye sees it all the same";
}

TEST(NodeOptions, D2_WhatIsNotSeenIsNoReceiver) {
  const std::vector<std::string> views = {"shadow"};
  const Frame both = frameOf({kSun}, {}, views);
  const Frame hidden = frameOf({kSun}, {{{"node", "box"}, {"visible", false}, {"castShadow", true}}}, views);
  EXPECT_LT(hidden.report.counts.surveyedTriangles, both.report.counts.surveyedTriangles);
  EXPECT_LT(hidden.report.counts.shadedTriangles, both.report.counts.shadedTriangles);
  EXPECT_NEAR(both.report.depthRange.at(0), 9.5, 0.01);
  EXPECT_GT(hidden.report.depthRange.at(0), 11.9) << "the shadow's range starts at what is seen";
  const Frame nothing = frameOf(
      {kSun}, {{{"node", 0}, {"visible", false}}, {{"node", 2}, {"visible", false}}, {{"node", 3}, {"visible", false}}},
      {"depth"});
  EXPECT_EQ(nothing.report.counts.surveyedTriangles, 0u);
  EXPECT_EQ(nothing.report.counts.casterTriangles, 0u);
}

TEST(NodeOptions, X14_ALightLightsOnlyNodesOfItsLayersAndOnlyTheyCast) {
  const Json box = {{"node", "box"}, {"layers", 2}};
  for (const Json& type : kLightsOfEachType) {
    Json light = type;
    light["cullingMask"] = 1;
    const Frame ground = frameOf({light}, {box}, {"color"});
    EXPECT_EQ(redAt(ground, kOnBox), 0.0f) << light;
    EXPECT_GT(redAt(ground, kInShadow), 0.05f) << "what a light doesn't light casts nothing from it" << light;
    light["cullingMask"] = 2;
    const Frame onBox = frameOf({light}, {box}, {"color"});
    EXPECT_GT(redAt(onBox, kOnBox), 0.05f) << light;
    EXPECT_EQ(redAt(onBox, kInTheSun), 0.0f) << light;
    light["cullingMask"] = 3;
    const Frame all = frameOf({light}, {box}, {"color"});
    EXPECT_EQ(redAt(all, kOnBox), redAt(onBox, kOnBox)) << light;
    EXPECT_EQ(redAt(all, kInShadow), 0.0f) << light;
  }
}

TEST(NodeOptions, X14_ALightWithoutCastersOrReceiversHasNoTiles) {
  Json box = kSun;
  box["cullingMask"] = 2;
  const auto lightOf = [&](bool castShadow, bool receiveShadow) {
    const Frame frame =
        frameOf({box}, {{{"node", "box"}, {"layers", 2}, {"castShadow", castShadow}, {"receiveShadow", receiveShadow}}},
                {"shadow"});
    return frame.report.lights.at(0);
  };
  EXPECT_TRUE(lightOf(true, true).shadowed);
  EXPECT_FALSE(lightOf(false, true).shadowed);
  EXPECT_EQ(lightOf(false, true).note, "nothing that it lights casts a shadow");
  EXPECT_FALSE(lightOf(true, false).shadowed);
  EXPECT_EQ(lightOf(true, false).note, "nothing that it lights receives a shadow");
}

TEST(NodeOptions, X14_LightsAddUpEachOnItsOwnLayers) {
  Json first = kSun;
  first["cullingMask"] = 1;
  Json second = {{"type", "directional"}, {"direction", {-1, -2, 0}}, {"cullingMask", 2}, {"color", {0.5, 1, 1}}};
  const Jsons nodes = {{{"node", "box"}, {"layers", 2}}, {{"node", "card"}, {"layers", 3}}};
  const Frame one = frameOf({first}, nodes, {"color"});
  const Frame other = frameOf({second}, nodes, {"color"});
  const Frame both = frameOf({first, second}, nodes, {"color"});
  for (const Place& place : {kOnBox, kOnCard, kInTheSun, kInShadow}) {
    EXPECT_NEAR(redAt(both, place), redAt(one, place) + redAt(other, place), 1e-5) << place.x;
  }
  EXPECT_GT(redAt(one, kOnCard), 0.05f);
  EXPECT_GT(redAt(other, kOnCard), 0.05f);
}

TEST(NodeOptions, X14_TheEdgeBetweenGroupsIsAntialiased) {
  // Two halves of one plane, alike but for the lights that light them; their edge crosses the picture at a slant.
  testing::GlbBuilder halves = testing::plane();
  halves.json["nodes"][0]["translation"] = {-1, 0, 0};
  halves.addRoot({{"mesh", 0}, {"translation", {1, 0, 0}}});
  const Frame frame = renderJson(testing::sceneOf(halves),
                                 R"({"width":64,"height":64,"ambient":{"intensity":0},"toneMapping":"none",
      "camera":{"eye":[0,8,0],"target":[0,0,0],"up":[0.1,0,-1],"orthographic":{"height":1,"near":1,"far":20}},
      "lights":[{"type":"directional","direction":[0,-1,0],"cullingMask":1}],"nodes":[{"node":1,"layers":2}],
      "output":{"format":"exr"}})");
  const auto& color = floatsOf(frame);
  const float lit = std::max(color.front(), color.back());
  EXPECT_EQ(std::min(color.front(), color.back()), 0.0f);
  int between = 0;
  for (std::size_t i = 0; i < color.size(); i += 3) between += color[i] > 0.1f * lit && color[i] < 0.9f * lit ? 1 : 0;
  EXPECT_GE(between, 32) << "about one pixel a row";
}

TEST(NodeOptions, D2_SwitchesThatChangeNothingChangeNoByte) {
  Json plain = spec({kSun}, {}, {"color"});
  plain["output"] = {{"format", "png"}};
  Json switched = plain;
  switched["nodes"] =
      Jsons{{{"node", "ground"}, {"visible", true}, {"layers", 12}}, {{"node", "card"}, {"castShadow", true}}};
  const ScenePtr scene = stage();
  const Frame frame = renderJson(scene, switched.dump());
  EXPECT_EQ(testing::pngOf(renderJson(scene, plain.dump())), testing::pngOf(frame));
  EXPECT_EQ(testing::pngOf(renderJson(scene, toJson(frame.report.spec).dump())), testing::pngOf(frame))
      << "asked again";
}

} // namespace
} // namespace gnomon
