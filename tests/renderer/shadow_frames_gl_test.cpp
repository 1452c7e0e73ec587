// What the shadow rows of the design promise, seen in rendered frames.

#include "protocol/json/json_codec.h"
#include "tests/renderer/frame_fixture.h"

namespace gnomon {
namespace {

using testing::floatsOf;
using testing::renderJson;

const std::string kWallSpec = R"({"width":160,"height":90,"camera":{"node":"camera"},"antialiasing":"none",
    "lights":[{"type":"directional","sun":{"azimuthDegrees":180,"elevationDegrees":25}}],
    "views":["shadow"],"output":{"format":"exr"}})";

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

} // namespace
} // namespace gnomon
