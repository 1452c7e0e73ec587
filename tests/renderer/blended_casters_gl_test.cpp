// What materials of alphaMode BLEND cast, seen in rendered frames.
#include <algorithm>
#include <numeric>

#include "protocol/json/json_codec.h"
#include "tests/renderer/frame_fixture.h"

namespace gnomon {
namespace {

using testing::floatsOf;
using testing::renderJson;

/// A ground of 20 m, material 0 of that alphaMode and alpha, and no other node yet; mesh 0 is a square of 2 m.
testing::GlbBuilder groundFor(const std::string& alphaMode, double alpha) {
  testing::GlbBuilder builder = testing::plane();
  builder.json["nodes"][0]["scale"] = {10, 1, 10};
  builder.add("materials",
              {{"alphaMode", alphaMode}, {"pbrMetallicRoughness", {{"baseColorFactor", {1, 1, 1, alpha}}}}});
  return builder;
}

/// The square's corners, and the same `behind` metres lower; the lower square's triangles faced up or down.
Json twoSquares(testing::GlbBuilder& builder, float behind, bool secondFacesUp) {
  const int position = builder.addPoints({{-1, 0, 1},
                                          {1, 0, 1},
                                          {1, 0, -1},
                                          {-1, 0, -1},
                                          {-1, -behind, 1},
                                          {1, -behind, 1},
                                          {1, -behind, -1},
                                          {-1, -behind, -1}});
  const auto indices = secondFacesUp ? std::vector<std::uint16_t>{0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7}
                                     : std::vector<std::uint16_t>{0, 1, 2, 0, 2, 3, 4, 6, 5, 4, 7, 6};
  return {{"attributes", {{"POSITION", position}}}, {"indices", builder.addShortIndices(indices)}, {"material", 0}};
}

/// A ground of 20 m, and a sheet of 10 m at y 2 of that alphaMode and alpha.
ScenePtr sheetOver(const std::string& alphaMode, double alpha) {
  testing::GlbBuilder builder = groundFor(alphaMode, alpha);
  auto& json = builder.json;
  builder.add("meshes", json["meshes"][0]);
  json["meshes"][1]["primitives"][0]["material"] = 0;
  builder.addRoot({{"mesh", 1}, {"scale", {5, 1, 5}}, {"translation", {0, 2, 0}}});
  return testing::sceneOf(builder);
}

/// The same with two sheets of one primitive.
ScenePtr paneOver(double alpha, bool secondFacesUp) {
  testing::GlbBuilder builder = groundFor("BLEND", alpha);
  const int mesh = builder.addMesh(twoSquares(builder, 0.05f, secondFacesUp));
  builder.addRoot({{"mesh", mesh}, {"scale", {5, 1, 5}}, {"translation", {0, 2, 0}}});
  return testing::sceneOf(builder);
}

/// The same with a node a sheet, both of one mesh.
ScenePtr sheetsOver(double alpha) {
  testing::GlbBuilder builder = groundFor("BLEND", alpha);
  auto& json = builder.json;
  builder.add("meshes", json["meshes"][0]);
  json["meshes"][1]["primitives"][0]["material"] = 0;
  for (const double y : {2.0, 1.5}) builder.addRoot({{"mesh", 1}, {"scale", {5, 1, 5}}, {"translation", {0, y, 0}}});
  return testing::sceneOf(builder);
}

const std::vector<Json> kLights = Json::parse(R"([{"type":"directional","direction":[0.1,-1,0.05]},
    {"type":"spot","position":[0.3,9,0.2],"direction":[0,-1,0.01],"outerConeDegrees":40},
    {"type":"point","position":[0.3,9,0.2]}])");

/// The shadow view from `height`, straight down: at 1 m the ground below the sheet, at 6 m the sheet from above.
Json spec(const Json& light, const char* blendedCasters, double height) {
  return {{"width", 96},
          {"height", 96},
          {"camera", {{"eye", {0, height, 0}}, {"target", {0, 0, 0}}, {"up", {0, 0, -1}}}},
          {"lights", {light}},
          {"shadow", {{"filter", {{"type", "pcf"}, {"size", 7}}}, {"blendedCasters", blendedCasters}}},
          {"antialiasing", "none"},
          {"views", {"shadow"}},
          {"output", {{"format", "exr"}, {"exrPixelType", "float"}}}};
}

double meanOf(const Frame& frame) {
  const auto& visibility = floatsOf(frame);
  return std::accumulate(visibility.begin(), visibility.end(), 0.0) / static_cast<double>(visibility.size());
}

TEST(BlendedCasters, X34_DitheringLetsThroughTheShareThatAlphaLeaves) {
  for (const double alpha : {0.0, 0.25, 0.5, 0.75, 1.0}) {
    const ScenePtr scene = sheetOver("BLEND", alpha);
    for (const Json& light : kLights) {
      const Frame frame = renderJson(scene, spec(light, "dither", 1).dump());
      EXPECT_NEAR(meanOf(frame), 1 - alpha, 0.05) << alpha << light;
      // Spread so evenly that the filter leaves little of the pattern: of mere noise, twice as much.
      const auto [least, most] = std::minmax_element(floatsOf(frame).begin(), floatsOf(frame).end());
      EXPECT_LT(*most - *least, 0.3f) << alpha << light;
    }
  }
}

TEST(BlendedCasters, X34_SheetsBehindEachOtherLetThroughTheProductOfTheirShares) {
  double sum = 0;
  int frames = 0;
  for (const double alpha : {0.25, 0.4, 0.5, 0.75}) {
    const std::vector<std::pair<const char*, ScenePtr>> scenes{{"the two sides of a pane", paneOver(alpha, false)},
                                                               {"two sheets of a primitive", paneOver(alpha, true)},
                                                               {"two nodes", sheetsOver(alpha)}};
    for (const auto& [name, scene] : scenes) {
      for (const Json& light : kLights) {
        Json wide = spec(light, "dither", 1);
        wide["camera"]["perspective"]["fovYDegrees"] = 130; // of many parts of 8 x 8 texels
        const Frame frame = renderJson(scene, wide.dump());
        const double off = meanOf(frame) - (1 - alpha) * (1 - alpha);
        EXPECT_NEAR(off, 0, 0.06) << name << ' ' << alpha << light; // by how the patterns of its few parts meet
        sum += off;
        ++frames;
      }
    }
  }
  EXPECT_NEAR(sum / frames, 0, 0.01);
}

/// Share of the pixels that pass for lit, half of the light or more; below two sheets of alpha 0.4 it is 0.36.
double passingForLit(const ScenePtr& scene) {
  const Frame frame = renderJson(scene, spec(kLights[0], "dither", 1).dump());
  const auto& visibility = floatsOf(frame);
  const auto lit = std::count_if(visibility.begin(), visibility.end(), [](float share) { return share >= 0.5f; });
  return static_cast<double>(lit) / static_cast<double>(visibility.size());
}

TEST(BlendedCasters, X34_ThePatternsOfAPanesSidesFitTogether) {
  const double sides = passingForLit(paneOver(0.4, false));
  EXPECT_LT(sides, 0.1);
  EXPECT_LT(sides, 0.6 * passingForLit(paneOver(0.4, true))) << "those of two surfaces that know nothing of each other";
}

TEST(BlendedCasters, X34_AThresholdCastsAllOrNothing) {
  for (const double alpha : {0.0, 0.25, 0.49, 0.5, 0.75, 1.0}) {
    const ScenePtr scene = sheetOver("BLEND", alpha);
    for (const Json& light : kLights) {
      const Frame frame = renderJson(scene, spec(light, "threshold", 1).dump());
      for (const float visibility : floatsOf(frame))
        ASSERT_NEAR(visibility, alpha >= 0.5 ? 0.0f : 1.0f, 1e-5f) << alpha << light;
    }
  }
}

TEST(BlendedCasters, X34_WhatIsDitheredDoesNotShadowItself) {
  const ScenePtr scene = sheetOver("BLEND", 0.75);
  for (const Json& light : kLights) {
    const Frame frame = renderJson(scene, spec(light, "dither", 6).dump());
    for (const float visibility : floatsOf(frame)) ASSERT_NEAR(visibility, 1.0f, 1e-5f) << light;
  }
}

TEST(BlendedCasters, G2_AMaskIsNeverDithered) {
  const ScenePtr scene = sheetOver("MASK", 0.6);
  const Frame frame = renderJson(scene, spec(kLights[0], "dither", 1).dump());
  for (const float visibility : floatsOf(frame)) ASSERT_NEAR(visibility, 0.0f, 1e-5f);
}

TEST(BlendedCasters, X34_EachLightChoosesForItself) {
  const ScenePtr scene = sheetOver("BLEND", 0.25);
  Json both = spec(kLights[0], "dither", 1);
  Json other = kLights[0];
  other["shadow"] = {{"blendedCasters", "threshold"}};
  both["lights"] = {kLights[0], other};
  both["views"] = {"color"};
  both["ambient"] = {{"intensity", 0}};
  const double color = meanOf(renderJson(scene, both.dump()));
  both["lights"] = {other};
  EXPECT_NEAR(color / meanOf(renderJson(scene, both.dump())), 1.75, 0.05) << "one let all through, one three quarters";
}

} // namespace
} // namespace gnomon
