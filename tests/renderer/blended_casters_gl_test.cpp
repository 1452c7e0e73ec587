// What materials of alphaMode BLEND cast, seen in rendered frames.
#include <algorithm>
#include <numeric>

#include "protocol/json_codec.h"
#include "tests/renderer/frame_fixture.h"

namespace gnomon {
namespace {

using testing::floatsOf;
using testing::renderJson;

/// A ground of 20 m, and a sheet of 10 m at y 2 of that alphaMode and alpha.
ScenePtr sheetOver(const std::string& alphaMode, double alpha) {
  testing::GlbBuilder builder = testing::plane();
  auto& json = builder.json;
  json["nodes"][0]["scale"] = {10, 1, 10};
  builder.add("meshes", json["meshes"][0]);
  builder.add("materials",
              {{"alphaMode", alphaMode}, {"pbrMetallicRoughness", {{"baseColorFactor", {1, 1, 1, alpha}}}}});
  json["meshes"][1]["primitives"][0]["material"] = 0;
  builder.addRoot({{"mesh", 1}, {"scale", {5, 1, 5}}, {"translation", {0, 2, 0}}});
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
      // Spread so evenly that the filter leaves little of the pattern.
      const auto [least, most] = std::minmax_element(floatsOf(frame).begin(), floatsOf(frame).end());
      EXPECT_LT(*most - *least, 0.25f) << alpha << light;
    }
  }
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

TEST(BlendedCasters, G2_WhatIsWhollyTransparentCastsNothing) {
  const ScenePtr scene = sheetOver("BLEND", 0);
  for (const char* mode : {"dither", "threshold"}) {
    for (const Json& light : kLights) {
      const Frame frame = renderJson(scene, spec(light, mode, 1).dump());
      for (const float visibility : floatsOf(frame)) ASSERT_NEAR(visibility, 1.0f, 1e-5f) << mode << light;
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
