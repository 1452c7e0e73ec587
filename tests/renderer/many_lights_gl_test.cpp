// Frames with more lights than are tried at every pixel.
#include <cmath>

#include "tests/renderer/frame_fixture.h"

namespace gnomon {
namespace {

using testing::floatsOf;
using testing::renderJson;

Json frameSpec(const Json& lights) {
  return {{"width", 320},
          {"height", 180},
          {"lights", lights},
          {"ambient", {{"intensity", 0}}},
          {"background", {{"color", {0, 0, 0}}}},
          {"antialiasing", "none"},
          {"output", {{"format", "exr"}}}};
}

/// Lamps of every type over the box, each of a few metres' reach.
Json lampsAround(int count) {
  Json lamps = Json::array();
  for (int i = 0; i < count; ++i) {
    const double angle = i * 2.39996;
    const double away = 1.5 + 0.15 * i;
    Json lamp = {{"type", i % 3 == 0 ? "point" : "spot"},
                 {"position", {away * std::cos(angle), 1.0 + i % 5, away * std::sin(angle)}},
                 {"range", 3.0 + i % 4},
                 {"intensity", 5},
                 {"shadow", {{"enabled", i % 2 == 0}, {"size", "XSmall"}}}};
    if (i % 3 != 0) lamp["direction"] = {-std::cos(angle), -1, -std::sin(angle)};
    lamps.push_back(lamp);
  }
  lamps.push_back({{"type", "directional"}, {"sun", Json::object()}, {"intensity", 0.2}});
  return lamps;
}

TEST(ManyLights, LightAddsUpHoweverManyLightsThereAre) {
  const ScenePtr scene = testing::generatedScene("box_on_plane");
  const Json lamps = lampsAround(40);
  const Frame together = renderJson(scene, frameSpec(lamps).dump());
  std::vector<double> sum(floatsOf(together).size());
  for (const Json& lamp : lamps) {
    const Frame alone = renderJson(scene, frameSpec(Json::array({lamp})).dump());
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += floatsOf(alone)[i];
  }
  double brightest = 0;
  for (std::size_t i = 0; i < sum.size(); ++i) {
    EXPECT_NEAR(floatsOf(together)[i], sum[i], 1e-4 + 1e-5 * sum[i]) << i;
    brightest = std::max(brightest, sum[i]);
  }
  EXPECT_GT(brightest, 0.1);
}

TEST(ManyLights, X11_AsManyShadowedLightsAsAFrameMayHaveAreEachDrawnOrExplained) {
  const ScenePtr scene = testing::generatedScene("box_on_plane");
  Json lamps = lampsAround(kLimits.maxLights - 1);
  for (Json& lamp : lamps) lamp["shadow"] = {{"size", "Large"}};
  Json spec = frameSpec(lamps);
  spec["atlas"] = {{"size", 1024}};
  const Frame frame = renderJson(scene, spec.dump());
  ASSERT_EQ(frame.report.lights.size(), lamps.size());
  int drawn = 0;
  for (const LightReport& light : frame.report.lights) {
    EXPECT_TRUE(light.shadowed || !light.note.empty()) << light.light;
    EXPECT_TRUE(!light.shadowed || light.grantedTileSize == light.askedTileSize || !light.note.empty()) << light.light;
    drawn += light.shadowed ? 1 : 0;
  }
  EXPECT_GT(drawn, 20);
}

TEST(ManyLights, AnAtlasBeyondAFramesMemoryIsRefused) {
  Json spec = frameSpec(Json::array({{{"type", "directional"}, {"sun", Json::object()}}}));
  spec["atlas"] = {{"size", 8192}, {"baseSize", 4096}};
  spec["width"] = 2560;
  spec["shadow"] = {{"filter", {{"type", "msm"}}}};
  const Problems problems = testing::refusedJson(testing::generatedScene("long_row"), spec.dump());
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].code, ProblemCode::tooLarge);
  EXPECT_EQ(problems[0].pointer, "/atlas/size");
  EXPECT_EQ(problems[0].limit, "536870912 bytes");
}

} // namespace
} // namespace gnomon
