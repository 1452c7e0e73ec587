// Shadows where distances are extreme: casters at the light, no far plane, a world far from its origin.

#include "tests/renderer/frame_fixture.h"

namespace gnomon {
namespace {

using testing::floatsOf;
using testing::renderJson;

Json shadowSpec(const Json& light) {
  return {{"width", 200},
          {"height", 200},
          {"lights", {light}},
          {"shadow", {{"size", "Large"}}},
          {"antialiasing", "none"},
          {"views", {"shadow"}},
          {"output", {{"format", "exr"}}}};
}

double darkShare(const Frame& frame) {
  const auto& visibility = floatsOf(frame);
  const auto dark = std::count_if(visibility.begin(), visibility.end(), [](float v) { return v < 0.5f; });
  return static_cast<double>(dark) / static_cast<double>(visibility.size());
}

TEST(Extremes, X31_X32_ACasterHoweverCloseToItsLightCasts) {
  for (const double gap : {0.5, 0.05, 0.001}) {
    // A card that spans a quarter turn seen from the light, so that its shadow is the same from any distance: 8 m x 8
    // m.
    testing::GlbBuilder builder = testing::plane();
    nlohmann::json card = builder.json["nodes"][0];
    builder.json["nodes"][0]["scale"] = {10, 1, 10};
    card["scale"] = {gap, 1, gap};
    card["translation"] = {0, 4 - gap, 0};
    builder.addRoot(card);
    const ScenePtr scene = testing::sceneOf(builder);
    for (const Json& light :
         {Json{{"type", "point"}, {"position", {0, 4, 0}}},
          Json{{"type", "spot"}, {"position", {0, 4, 0}}, {"direction", {0, -1, 0}}, {"outerConeDegrees", 55}}}) {
      Json spec = shadowSpec(light);
      spec["camera"] = Json::parse(R"({"eye":[0,3,0],"target":[0,0,0],"up":[0,0,-1],
                                       "orthographic":{"height":16,"near":0,"far":10}})");
      EXPECT_NEAR(darkShare(renderJson(scene, spec.dump())), 0.25, 0.01) << gap << " m, " << light;
    }
  }
}

TEST(Extremes, G5_WithoutAFarPlaneTheShadowsAreThoseOfAFarOne) {
  const ScenePtr scene = testing::generatedScene("long_row");
  Json spec = shadowSpec(Json::parse(R"({"type":"directional","sun":{"azimuthDegrees":120,"elevationDegrees":40}})"));
  spec["camera"] = Json::parse(R"({"eye":[0,3,4],"target":[0,2.2,-20],"perspective":{"fovYDegrees":50,"near":0.1}})");
  const Frame endless = renderJson(scene, spec.dump());
  spec["camera"]["perspective"]["far"] = 500;
  const Frame bounded = renderJson(scene, spec.dump());
  EXPECT_GT(darkShare(endless), 0.05);
  EXPECT_NEAR(darkShare(endless), darkShare(bounded), 0.001);
}

} // namespace
} // namespace gnomon
