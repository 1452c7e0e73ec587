// What the shadow rows of the design promise, seen in rendered frames.
#include <cmath>
#include <numeric>

#include "protocol/json/json_codec.h"
#include "tests/renderer/frame_fixture.h"

namespace gnomon {
namespace {

using testing::floatsOf;
using testing::renderJson;
using testing::valueAt;

/// The unit plane, scaled and turned about X, lit from straight above.
ScenePtr tiltedPlane(double degrees) {
  testing::GlbBuilder builder = testing::plane();
  const double half = degrees * 3.14159265358979 / 360;
  builder.json["nodes"][0]["rotation"] = {std::sin(half), 0, 0, std::cos(half)};
  builder.json["nodes"][0]["scale"] = {10, 10, 10};
  return testing::sceneOf(builder);
}

std::string acneSpec(double degrees, const Json& filter, double eyeLift, int cascades) {
  const double angle = degrees * 3.14159265358979 / 180;
  // From the lit side: along the plane's normal, leaning over by eyeLift.
  const double y = std::cos(angle) * 15 - std::sin(angle) * eyeLift;
  const double z = std::sin(angle) * 15 + std::cos(angle) * eyeLift;
  return Json{{"width", 128},
              {"height", 128},
              {"camera", {{"eye", {1.7, y, z}}, {"target", {0, 0, 0}}, {"up", {0.1, 0, -1}}}},
              {"lights", {{{"type", "directional"}, {"direction", {0.03, -1, 0}}, {"angularDiameterDegrees", 1}}}},
              {"shadow", {{"filter", filter}, {"cascadeCount", cascades}, {"size", "Small"}}},
              {"antialiasing", "none"},
              {"views", {"shadow"}},
              {"output", {{"format", "exr"}}}}
      .dump();
}

TEST(ShadowFrames, H4_NoAcneOnPlanesOfAnyTilt) {
  for (const double degrees : {0.0, 7.0, 30.0, 45.0, 60.0, 75.0, 85.0, 89.0}) {
    const ScenePtr scene = tiltedPlane(degrees);
    for (const Json& filter : testing::everyFilter()) {
      for (const double eyeLift : {2.0, 30.0}) {
        for (const int cascades : {1, 4}) {
          const Frame frame = renderJson(scene, acneSpec(degrees, filter, eyeLift, cascades));
          const auto& visibility = floatsOf(frame);
          const auto dark = std::count_if(visibility.begin(), visibility.end(), [](float v) { return v < 0.999f; });
          EXPECT_EQ(dark, 0) << degrees << " degrees, " << filter << ", lift " << eyeLift << ", " << cascades;
        }
      }
    }
  }
}

const std::string kWallSpec = R"({"width":160,"height":90,"camera":{"node":"camera"},"antialiasing":"none",
    "lights":[{"type":"directional","sun":{"azimuthDegrees":180,"elevationDegrees":25}}],
    "views":["shadow"],"output":{"format":"exr"}})";

TEST(ShadowFrames, M5_X26_ACasterBehindTheCameraShadesWhatIsAhead) {
  const Frame frame = renderJson(testing::generatedScene("caster_behind_camera"), kWallSpec);
  EXPECT_EQ(valueAt(frame, 0.5, 0.95), 0.0f) << "at the camera's feet";
  EXPECT_FLOAT_EQ(valueAt(frame, 0.02, 0.55), 1.0f) << "beside the wall's shadow";
}

TEST(ShadowFrames, G2_HolesOfAMaskedCasterLetTheLightThrough) {
  const Frame frame =
      renderJson(testing::generatedScene("mask_leaf"),
                 R"({"width":400,"height":400,"camera":{"eye":[0.01,12,0],"target":[0,0,0],"up":[0,0,-1]},
      "lights":[{"type":"directional","direction":[1.5,-1,0]}],"shadow":{"filter":{"type":"hard"}},
      "antialiasing":"none","views":["shadow"],"output":{"format":"exr"}})");
  const auto& visibility = floatsOf(frame);
  const auto dark =
      static_cast<double>(std::count_if(visibility.begin(), visibility.end(), [](float v) { return v < 0.5f; }));
  // 8 of the card's 16 squares of 0.25 m2 cast, beside the card; 400 px show 2 * 12 * tan(22.5 degrees) = 9.94 m.
  const double expected = 2.0 / (9.94 * 9.94) * 400 * 400;
  EXPECT_NEAR(dark, expected, 0.15 * expected);
}

TEST(ShadowFrames, M10_StrengthIsTheShareThatTheShadowTakes) {
  for (const double strength : {0.0, 0.25, 1.0}) {
    Json spec = Json::parse(kWallSpec);
    spec["shadow"]["strength"] = strength;
    const Frame frame = renderJson(testing::generatedScene("caster_behind_camera"), spec.dump());
    EXPECT_NEAR(valueAt(frame, 0.5, 0.95), 1.0 - strength, 1e-6);
  }
}

TEST(ShadowFrames, D8_AColorIsWhatAFullShadowLeavesWhateverFindsIt) {
  const ScenePtr scene = testing::generatedScene("caster_behind_camera");
  Json spec = Json::parse(kWallSpec);
  spec["views"] = {"color"};
  spec["ambient"] = {{"intensity", 0}};
  // Half a row above the picture's lower edge, in its middle: at the camera's feet.
  const auto rgbOf = [&](const Json& shadow) {
    Json patched = spec;
    patched["shadow"] = shadow;
    const Frame frame = renderJson(scene, patched.dump());
    const Image& image = frame.images[0].image;
    const auto row = static_cast<std::size_t>(0.95 * image.height), column = static_cast<std::size_t>(image.width / 2);
    const float* pixel =
        &floatsOf(frame)[(row * static_cast<std::size_t>(image.width) + column) * image.channels.size()];
    return glm::dvec3(pixel[0], pixel[1], pixel[2]);
  };
  const glm::dvec3 lit = rgbOf({{"enabled", false}});
  const glm::dvec3 color(0.25, 0.5, 0.75);
  for (const char* technique : {"shadowMap", "rayTraced", "lightMap"}) {
    for (const double strength : {0.5, 1.0}) {
      const glm::dvec3 shown =
          rgbOf({{"technique", technique}, {"strength", strength}, {"color", {color.r, color.g, color.b}}});
      const glm::dvec3 expected = lit * (1.0 - strength * (1.0 - color));
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(shown[c], expected[c], 2e-3 * lit[c]) << technique << ' ' << strength;
    }
    EXPECT_EQ(rgbOf({{"technique", technique}}), glm::dvec3(0)) << technique << ": black unless asked";
  }
}

TEST(ShadowFrames, X21_X23_BeyondAManualRangeEverythingIsLit) {
  Json spec = Json::parse(kWallSpec);
  spec["shadow"]["depthRange"] = {{"mode", "manual"}, {"min", 0}, {"max", 3}};
  const Frame shallow = renderJson(testing::generatedScene("caster_behind_camera"), spec.dump());
  spec["shadow"]["depthRange"]["max"] = 60;
  const Frame deep = renderJson(testing::generatedScene("caster_behind_camera"), spec.dump());
  EXPECT_EQ(valueAt(deep, 0.5, 0.75), 0.0f);
  EXPECT_EQ(valueAt(shallow, 0.5, 0.75), 1.0f);
}

TEST(ShadowFrames, X13_ATileNeverReadsItsNeighbour) {
  const std::string sun = R"({"type":"directional","sun":{"azimuthDegrees":120,"elevationDegrees":40}})";
  const std::string other = R"({"type":"directional","sun":{"azimuthDegrees":300,"elevationDegrees":15}})";
  Json spec = Json::parse(R"({"width":320,"height":180,"camera":{"node":"camera"},"antialiasing":"none",
      "shadow":{"size":"XSmall","filter":{"type":"pcf","size":7}},"views":["shadow"],"output":{"format":"exr"}})");
  const ScenePtr scene = testing::generatedScene("long_row");
  spec["lights"] = Json::array({Json::parse(sun)});
  const std::vector<float> alone = floatsOf(renderJson(scene, spec.dump()));
  spec["lights"].push_back(Json::parse(other));
  EXPECT_EQ(alone, floatsOf(renderJson(scene, spec.dump()))) << "another light's tiles stand beside";
}

TEST(ShadowFrames, M3_LightsAtAndNearTheVerticalGiveFinitePictures) {
  const ScenePtr scene = testing::generatedScene("box_on_plane");
  for (const double up : {-1.0, 1.0}) {
    for (const double tilt : {0.0, 1e-7, -1e-6, 1e-4, 1e-2}) {
      const Json spec = {{"width", 64},
                         {"height", 64},
                         {"lights", {{{"type", "directional"}, {"direction", {tilt, up, 0}}}}},
                         {"views", {"color", "shadow"}},
                         {"output", {{"format", "exr"}}}};
      const Frame frame = renderJson(scene, spec.dump());
      for (const std::size_t view : {0u, 1u}) {
        for (const float value : floatsOf(frame, view)) ASSERT_TRUE(std::isfinite(value)) << tilt;
      }
    }
  }
}

TEST(ShadowFrames, D1_EveryDirectionalLightCasts) {
  const Frame frame = renderJson(testing::generatedScene("box_on_plane"),
                                 R"({"width":64,"height":64,"lights":[{"type":"directional","direction":[1,-1,0]},
      {"type":"directional","direction":[0,-1,1],"shadow":{"cascadeCount":2}}]})");
  ASSERT_EQ(frame.report.lights.size(), 2u);
  EXPECT_EQ(frame.report.lights[0].tiles.size(), 4u);
  EXPECT_EQ(frame.report.lights[1].tiles.size(), 2u);
}

TEST(ShadowFrames, D1_OnRequestTheFirstDirectionalLightCastsAlone) {
  const Frame frame = renderJson(testing::generatedScene("box_on_plane"),
                                 R"({"width":64,"height":64,"shadowLightPolicy":"first","lights":[
      {"type":"point","position":[0,5,0]},{"type":"directional","direction":[1,-1,0]},
      {"type":"directional","direction":[0,-1,1]}]})");
  ASSERT_EQ(frame.report.lights.size(), 3u);
  EXPECT_FALSE(frame.report.lights[0].shadowed);
  EXPECT_TRUE(frame.report.lights[1].shadowed);
  EXPECT_FALSE(frame.report.lights[2].shadowed);
  EXPECT_NE(frame.report.lights[2].note.find("shadowLightPolicy"), std::string::npos);
}

TEST(ShadowFrames, X15_EightCascadesEachServeTheirPart) {
  const Frame frame = renderJson(testing::generatedScene("long_row"),
                                 R"({"width":160,"height":90,"camera":{"node":"camera"},
      "lights":[{"type":"directional","direction":[1,-1,0]}],"shadow":{"cascadeCount":8,"size":"Small"}})");
  const auto& cascades = frame.report.lights[0].tiles;
  ASSERT_EQ(cascades.size(), 8u);
  for (std::size_t i = 1; i < cascades.size(); ++i) {
    EXPECT_GT(cascades[i].far, cascades[i - 1].far);
    EXPECT_LT(cascades[i].near, cascades[i - 1].far) << "they overlap to blend";
  }
}

TEST(ShadowFrames, M14_CastersAreCulledPerTileAndHiddenClustersAreNotShaded) {
  const Frame frame = renderJson(testing::generatedScene("long_row"),
                                 R"({"width":320,"height":180,"camera":{"node":"camera"},
      "lights":[{"type":"directional","sun":{"azimuthDegrees":90,"elevationDegrees":60}}]})");
  const FrameCounts& counts = frame.report.counts;
  EXPECT_LE(counts.shadedTriangles, counts.surveyedTriangles);
  EXPECT_LT(counts.casterTriangles, 4 * counts.sceneTriangles);
  for (const TileReport& cascade : frame.report.lights[0].tiles) {
    EXPECT_EQ(cascade.casterTriangles + cascade.culledTriangles, counts.sceneTriangles);
    EXPECT_GT(cascade.culledTriangles, 0u);
  }
}

TEST(ShadowFrames, X18_NothingInViewCostsNoTile) {
  const Frame frame = renderJson(testing::generatedScene("box_on_plane"),
                                 R"({"width":64,"height":64,"camera":{"eye":[0,5,0],"target":[0,9,1]}})");
  EXPECT_EQ(frame.report.counts.casterTriangles, 0u);
  EXPECT_EQ(frame.report.atlasSize[0], 0);
  EXPECT_FALSE(frame.report.lights[0].note.empty());
}

TEST(ShadowFrames, X24_AutomaticRangeIgnoresStabilisationAndSaysSo) {
  const Frame frame = renderJson(testing::generatedScene("box_on_plane"),
                                 R"({"width":64,"height":64,"shadow":{"stabilization":"viewSnapping"}})");
  EXPECT_NE(frame.report.lights[0].note.find("tabiliz"), std::string::npos) << frame.report.lights[0].note;
}

} // namespace
} // namespace gnomon
