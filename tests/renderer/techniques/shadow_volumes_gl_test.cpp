// Technique shadowVolume, held against rays and closed forms: cameras and lights, one trap after another.
#include <algorithm>
#include <cmath>
#include <random>

#include "tests/renderer/techniques/volume_frames.h"

namespace gnomon {
namespace {

using testing::boxOverFloor;
using testing::cameraFrom;
using testing::Difference;
using testing::difference;
using testing::expectTruth;
using testing::floatsOf;
using testing::generatedScene;
using testing::placed;
using testing::renderJson;
using testing::shapes;
using testing::testLights;
using testing::usualCamera;
using testing::volumeSpec;

class AgainstRays : public ::testing::TestWithParam<const char*> {};

TEST_P(AgainstRays, N7_NoPixelOffTheEdgesDiffers) {
  const ScenePtr scene = generatedScene(GetParam());
  std::size_t receivers = 0;
  std::size_t atEdges = 0;
  for (const Json& light : {testLights().sun, testLights().lowSun, testLights().point, testLights().spot}) {
    const Difference found = difference(scene, volumeSpec(light, {{"node", "camera"}}));
    EXPECT_EQ(found.elsewhere, 0u) << light;
    EXPECT_LE(found.atEdges, 2 + found.receivers / 2000) << light;
    atEdges += found.atEdges;
    receivers += found.receivers;
  }
  RecordProperty("receivers", std::to_string(receivers));
  RecordProperty("differOnEdges", std::to_string(atEdges));
}

INSTANTIATE_TEST_SUITE_P(ShadowVolumes, AgainstRays,
                         ::testing::Values("box_on_plane", "tilted_planes", "long_row", "thin_slats", "mirrored_node",
                                           "double_sided", "caster_behind_camera", "lights"),
                         [](const auto& scene) { return std::string(scene.param); });

TEST(ShadowVolumes, N3_ABoxThrowsThePolygonThatItsCornersSpan) {
  // From straight above; the box floats from y = 0.5 to 2.5, and light of direction (0.5, -1, -0.25) moves each of its
  // corners by (0.5, -0.25) times its height: the shadow is the hull of both squares, a hexagon.
  const Json light = {{"type", "directional"}, {"direction", {0.5, -1, -0.25}}};
  Json spec = volumeSpec(light, {{"eye", {0, 20, 0}},
                                 {"target", {0, 0, 0}},
                                 {"up", {0, 0, -1}},
                                 {"orthographic", {{"height", 8}, {"near", 0.1}, {"far", 40}}}});
  spec["width"] = 400;
  spec["height"] = 400;
  spec["nodes"] = {{{"node", 1}, {"visible", false}, {"castShadow", true}}};
  const auto shown = floatsOf(renderJson(testing::sceneOf(boxOverFloor()), spec.dump()));
  std::size_t inside = 0;
  for (int row = 0; row < 400; ++row) {
    for (int column = 0; column < 400; ++column) {
      const double x = (column + 0.5) / 50 - 4;
      const double z = (row + 0.5) / 50 - 4;
      // In the shadow where some height h of the box is right above the point, seen along the light.
      double from = 0.5;
      double to = 2.5;
      const auto narrow = [&](double offset, double slope) { // |offset - slope h| <= 1
        from = std::max(from, std::min((offset - 1) / slope, (offset + 1) / slope));
        to = std::min(to, std::max((offset - 1) / slope, (offset + 1) / slope));
      };
      narrow(x, 0.5);
      narrow(z, -0.25);
      if (std::abs(to - from) < 0.01) continue; // half a pixel about the outline
      inside += to > from ? 1 : 0;
      ASSERT_EQ(shown[static_cast<std::size_t>(row * 400 + column)], to > from ? 0.0f : 1.0f) << x << ' ' << z;
    }
  }
  EXPECT_GT(inside, 10000u);
}

TEST(ShadowVolumes, N3_ASheetDoesNotShadowWhatLiesInItsPlane) {
  // Seen from above the roof, which faces down, is not there: the top of the block is, in the same plane.
  testing::GlbBuilder builder = shapes();
  builder.addRoot(placed(1, {0, 0, 0}, {20, 1, 20}));
  builder.addRoot(placed(0, {0, 1, 0}, {0.7, 1, 0.7}));
  nlohmann::json roof = placed(1, {0.13, 2, 0.27}, {1.9, 1, 1.7});
  roof["rotation"] = {1, 0, 0, 0};
  builder.addRoot(roof);
  const ScenePtr scene = testing::sceneOf(builder);
  for (const Json& light : {testLights().sun, testLights().lowSun, testLights().point}) {
    const Difference found = difference(scene, volumeSpec(light, cameraFrom({3, 6, 5}, {0, 1.5, 0})));
    EXPECT_EQ(found.elsewhere, 0u) << light;
    EXPECT_GT(found.shadowed, 100u) << light;
  }
}

TEST(ShadowVolumes, N3_TheNearPlaneMayCutVolumesAndCasters) {
  const ScenePtr scene = testing::sceneOf(boxOverFloor());
  for (const double near : {1e-4, 5.0, 9.0, 10.5}) {
    for (const Json& light : {testLights().sun, testLights().lowSun, testLights().point}) {
      Json spec = volumeSpec(light, usualCamera());
      spec["camera"]["perspective"] = {{"fovYDegrees", 50}, {"near", near}};
      expectTruth(scene, spec);
    }
  }
}

TEST(ShadowVolumes, N3_NoVolumeEndsAtTheFarPlane) {
  // The floor reaches far behind it, and so does a second box, whose shadow falls back into view.
  testing::GlbBuilder builder = boxOverFloor();
  builder.addRoot(placed(0, {-6, 2, -9}, {1, 2, 1}));
  const ScenePtr scene = testing::sceneOf(builder);
  const Json back = {{"type", "directional"}, {"direction", {0.5, -0.5, 0.8}}};
  for (const Json& far : Json{11.0, 14.0, 1e6, nullptr}) {
    for (const Json& light : {testLights().sun, testLights().lowSun, back, testLights().point}) {
      Json spec = volumeSpec(light, usualCamera());
      spec["camera"]["perspective"] = {{"fovYDegrees", 50}, {"near", 0.1}};
      if (!far.is_null()) spec["camera"]["perspective"]["far"] = far;
      expectTruth(scene, spec);
    }
  }
}

TEST(ShadowVolumes, N3_ALightMayStandInTheMiddleOfTheScene) {
  testing::GlbBuilder builder = boxOverFloor();
  builder.addRoot(placed(0, {-3, 0.6, 2}, {0.5, 0.5, 0.5}));
  builder.addRoot(placed(0, {2.5, 1, -3}, {0.4, 1, 0.4}));
  const ScenePtr scene = testing::sceneOf(builder);
  // So far above the first box. Nearer, a GPU's raster darkens the rim of its top: see LIMITATIONS.md.
  const double above = testing::drawnByGpu() ? 1e-3 : 1e-4;
  for (const Json& position : Json{{-1.6, 0.7, 0.4}, {1.5, 0.2, -1.6}, {0, 0.25, 0}, {0, 2.5 + above, 0}}) {
    const Json point = {{"type", "point"}, {"position", position}};
    const Json spot = {
        {"type", "spot"}, {"position", position}, {"direction", {-0.6, -0.2, 0.7}}, {"outerConeDegrees", 85}};
    for (const Json& light : {point, spot}) {
      const Difference found = difference(scene, volumeSpec(light, usualCamera()));
      EXPECT_EQ(found.elsewhere, 0u) << light;
      EXPECT_LE(found.atEdges, 2 + found.receivers / 1000) << light;
    }
  }
}

TEST(ShadowVolumes, G5_AnOrthographicCameraMayLookAlongTheLight) {
  const ScenePtr scene = testing::sceneOf(boxOverFloor());
  Json camera = {{"eye", {-5, 10, 3}},
                 {"target", {0, 0, 0}},
                 {"up", {0, 1, 0}},
                 {"orthographic", {{"height", 14}, {"near", 0}, {"far", 40}}}};
  for (const Json& light : {testLights().lowSun, testLights().point, testLights().spot})
    expectTruth(scene, volumeSpec(light, camera));
  for (const double tilt : {0.0, 1e-9, 1e-7, 1e-4, 1e-2}) {
    // With the view, no shadow can be seen, and against it every point seen under the box is in it.
    const Json with = {{"type", "directional"}, {"direction", {5 + tilt, -10, -3}}};
    const Difference none = difference(scene, volumeSpec(with, camera));
    EXPECT_EQ(none.elsewhere, 0u) << tilt;
    EXPECT_LE(none.shadowed, 200u) << tilt;
    const Json under = {{"eye", {5, -10, -3}},
                        {"target", {0, 0, 0}},
                        {"up", {0, 1, 0}},
                        {"orthographic", {{"height", 14}, {"near", 0}, {"far", 40}}}};
    EXPECT_EQ(difference(scene, volumeSpec(with, under)).elsewhere, 0u) << tilt;
  }
}

TEST(ShadowVolumes, N3_EverySampleOfAPixelHasItsOwnAnswer) {
  const ScenePtr scene = testing::sceneOf(boxOverFloor());
  Json spec = volumeSpec(testLights().sun, usualCamera());
  spec["views"] = {"lightContribution"};
  spec["antialiasing"] = "msaa4x";
  const auto shown = floatsOf(renderJson(scene, spec.dump()));
  spec["shadow"]["technique"] = "rayTraced";
  const auto traced = floatsOf(renderJson(scene, spec.dump()));
  ASSERT_EQ(shown.size(), traced.size());
  std::size_t different = 0;
  for (std::size_t i = 0; i < shown.size(); ++i) different += std::abs(shown[i] - traced[i]) > 0.02f ? 1 : 0;
  EXPECT_LE(different, shown.size() / 1000) << "rays go through the same samples";
}

TEST(ShadowVolumes, N4_LightFallsWhereNoVolumeIsAndAmbientEverywhere) {
  const ScenePtr scene = testing::sceneOf(boxOverFloor());
  Json spec = volumeSpec(testLights().sun, usualCamera());
  const auto visibility = floatsOf(renderJson(scene, spec.dump()));
  spec["views"] = {"color"};
  const Frame shadowed = renderJson(scene, spec.dump());
  spec["shadow"]["enabled"] = false;
  const auto lit = floatsOf(renderJson(scene, spec.dump()));
  spec["lights"][0]["intensity"] = 0;
  const auto dark = floatsOf(renderJson(scene, spec.dump()));
  const auto& shown = floatsOf(shadowed);
  const std::size_t channels = shown.size() / visibility.size();
  const float lastBits = testing::drawnByGpu() ? 1e-6f : 0; // its compiler's own in each of the three programs
  for (std::size_t i = 0; i < shown.size(); ++i) {
    ASSERT_NEAR(shown[i], visibility[i / channels] > 0.5f ? lit[i] : dark[i], lastBits) << i;
  }
}

/// Boxes and cards at random, turned and scaled, over a floor.
ScenePtr strewn(std::mt19937& random) {
  const auto within = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  testing::GlbBuilder builder = shapes();
  builder.addRoot(placed(1, {0, 0, 0}, {20, 1, 20}));
  for (int i = 0; i < 12; ++i) {
    nlohmann::json node = placed(i % 3 == 0 ? 1 : 0, {within(-4, 4), within(0.2, 3), within(-4, 4)},
                                 {within(0.1, 1), within(-0.8, 0.8), within(0.1, 1)});
    const glm::dvec4 turn = glm::normalize(glm::dvec4(within(-1, 1), within(-1, 1), within(-1, 1), within(0.1, 1)));
    node["rotation"] = {turn.x, turn.y, turn.z, turn.w};
    builder.addRoot(node);
  }
  return testing::sceneOf(builder);
}

TEST(ShadowVolumes, N7_AnySceneLightAndLensAgreesWithRays) {
  std::mt19937 random(11);
  const auto within = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  std::size_t elsewhere = 0;
  std::size_t receivers = 0;
  for (int i = 0; i < 60; ++i) {
    const ScenePtr scene = strewn(random);
    Json light = {{"type", i % 3 == 0 ? "directional" : i % 3 == 1 ? "point" : "spot"}};
    if (i % 3 != 1) light["direction"] = {within(-1, 1), within(-1, -0.1), within(-1, 1)};
    if (i % 3 != 0) light["position"] = {within(-4, 4), within(0.2, 6), within(-4, 4)};
    if (i % 3 == 2) light["outerConeDegrees"] = within(30, 89);
    Json spec = volumeSpec(light, cameraFrom({within(-6, 6), within(0.2, 6), within(-6, 6)},
                                             {within(-2, 2), within(0, 1), within(-2, 2)}));
    if (i % 4 == 3) {
      spec["camera"]["orthographic"] = {{"height", within(3, 12)}, {"near", within(-2, 1)}, {"far", within(8, 60)}};
    } else {
      spec["camera"]["perspective"] = {{"fovYDegrees", within(10, 150)}, {"near", within(0.001, 1)}};
      if (i % 2 == 0) spec["camera"]["perspective"]["far"] = within(5, 50);
    }
    const Difference found = difference(scene, spec);
    elsewhere += found.elsewhere;
    receivers += found.receivers;
    EXPECT_LE(found.atEdges, 3 + found.receivers / 1000) << i << ' ' << spec;
  }
  // One in a million may lie on a surface's own rim, where a volume's cap and wall meet.
  EXPECT_LE(elsewhere, 1 + receivers / 1000000);
}

} // namespace
} // namespace gnomon
