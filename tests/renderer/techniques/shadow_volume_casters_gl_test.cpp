// Technique shadowVolume: what may cast, and what it must not do to it.
#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>
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

TEST(ShadowVolumeCasters, N3_OpenMeshesDoNotShadowThemselves) {
  for (const double degrees : {0.0, 20.0, 45.0, 75.0, 89.0}) {
    testing::GlbBuilder builder = testing::plane();
    const double half = degrees * 3.14159265358979 / 360;
    builder.json["nodes"][0]["rotation"] = {std::sin(half), 0, 0, std::cos(half)};
    builder.json["nodes"][0]["scale"] = {10, 10, 10};
    const ScenePtr scene = testing::sceneOf(builder);
    const double angle = 2 * half;
    for (const Json& light : {testLights().vertical, Json{{"type", "point"}, {"position", {1, 8, 2}}}}) {
      for (const double far : {8.0, 1e4}) { // the plane reaches behind the first one
        Json spec = volumeSpec(light, cameraFrom({1.7, std::cos(angle) * 15 - std::sin(angle) * 4,
                                                  std::sin(angle) * 15 + std::cos(angle) * 4},
                                                 {0, 0, 0}));
        spec["camera"]["perspective"] = {{"fovYDegrees", 60}, {"near", 1e-3}, {"far", far + 8}};
        const auto shown = floatsOf(renderJson(scene, spec.dump()));
        EXPECT_EQ(std::count(shown.begin(), shown.end(), 1.0f), std::ssize(shown)) << degrees << ' ' << far << light;
      }
    }
  }
}

TEST(ShadowVolumeCasters, N3_OpenMeshesDoNotShadowThemselvesInAnySample) {
  testing::GlbBuilder builder = shapes();
  builder.addRoot(placed(1, {0, 0, 0}, {7, 1, 5}));
  builder.json["nodes"][0]["rotation"] = {0.2, 0.3, 0.1, 0.927};
  const ScenePtr scene = testing::sceneOf(builder);
  Json spec = volumeSpec(testLights().vertical, cameraFrom({3, 9, 6}, {0, 0, 0}));
  spec["antialiasing"] = "msaa4x";
  spec["views"] = {"lightContribution", "shadow"}; // four samples a pixel, and one
  const Frame shown = renderJson(scene, spec.dump());
  spec["shadow"]["enabled"] = false;
  const Frame unshadowed = renderJson(scene, spec.dump());
  // On the mesh's own rim, cap and wall meet: a sample there is as near to both as floats can tell.
  for (const std::size_t view : {0, 1}) {
    const auto& with = floatsOf(shown, view);
    const auto& without = floatsOf(unshadowed, view);
    ASSERT_EQ(with.size(), without.size());
    std::size_t different = 0;
    for (std::size_t i = 0; i < with.size(); ++i) different += std::abs(with[i] - without[i]) > 1e-6f ? 1 : 0;
    EXPECT_LE(different, with.size() / 10000) << view;
  }
}

/// Triangles at random, each for itself and in runs that share edges.
testing::GlbBuilder soup(std::mt19937& random, int triangles) {
  const auto within = [&](float low, float high) { return std::uniform_real_distribution<float>(low, high)(random); };
  std::vector<testing::Point> points;
  std::vector<std::uint32_t> indices;
  for (int t = 0; t < triangles; ++t) {
    const testing::Point middle{within(-3, 3), within(0.3f, 3), within(-3, 3)};
    const auto corner = [&] {
      points.push_back({middle[0] + within(-1, 1), middle[1] + within(-1, 1), middle[2] + within(-1, 1)});
      return static_cast<std::uint32_t>(points.size() - 1);
    };
    const bool shares = indices.size() >= 3 && t % 3 != 0;
    const std::uint32_t first = shares ? indices[indices.size() - 1] : corner();
    const std::uint32_t second = shares ? indices[indices.size() - 2] : corner();
    indices.insert(indices.end(), {first, second, corner()});
  }
  testing::GlbBuilder builder = shapes();
  const int material = builder.add("materials", {{"doubleSided", true}});
  const int mesh = builder.addMesh({{"attributes", {{"POSITION", builder.addPoints(points)}}},
                                    {"indices", builder.addIndices(indices)},
                                    {"material", material}});
  builder.addRoot(placed(1, {0, 0, 0}, {20, 1, 20}));
  builder.addMeshNode(mesh);
  return builder;
}

TEST(ShadowVolumeCasters, N3_OpenAndNonManifoldMeshesThrowTheirShadows) {
  std::mt19937 random(20);
  for (int i = 0; i < 4; ++i) {
    const ScenePtr scene = testing::sceneOf(soup(random, 30));
    for (const Json& light : {testLights().sun, testLights().lowSun, testLights().point, testLights().spot}) {
      const Difference found = difference(scene, volumeSpec(light, usualCamera()));
      EXPECT_GT(found.shadowed, 100u);
      EXPECT_EQ(found.elsewhere, 0u) << i << light;
      EXPECT_LE(found.atEdges, 2 + found.receivers / 1000) << i << light;
    }
  }
}

/// Cards of 2 m over a floor, one above the other, from 1 m upwards.
ScenePtr stack(int cards) {
  testing::GlbBuilder builder = shapes();
  builder.addRoot(placed(1, {0, 0, 0}, {20, 1, 20}));
  for (int i = 0; i < cards; ++i) builder.addRoot(placed(1, {0, 1 + 1e-4 * i, 0}, {1, 1, 1}));
  return testing::sceneOf(builder);
}

TEST(ShadowVolumeCasters, N3_CountsWrapRoundAndBack) {
  for (const int cards : {255, 257, 300}) {
    const ScenePtr scene = stack(cards);
    // From outside, from under the cards, and from between them.
    expectTruth(scene, volumeSpec(testLights().vertical, usualCamera()));
    expectTruth(scene, volumeSpec(testLights().sun, usualCamera()));
    expectTruth(scene, volumeSpec(testLights().sun, cameraFrom({0.1, 0.4, 0.2}, {2, 0, -2})));
    Json between = volumeSpec(testLights().sun, cameraFrom({0.1, 1.01505, 0.2}, {3, 0.9, -2}));
    between["camera"]["perspective"] = {{"fovYDegrees", 60}, {"near", 1e-5}};
    const Difference found = difference(scene, between);
    EXPECT_EQ(found.elsewhere, 0u) << cards;
  }
}

TEST(ShadowVolumeCasters, N3_256VolumesAtOnceAreTheLimit) {
  // Eight bits can't tell 256 from none: what renderer/LIMITATIONS.md says.
  const ScenePtr scene = stack(256);
  Json spec = volumeSpec(testLights().vertical, cameraFrom({3, 0.5, 3}, {0, 0, 0}));
  const auto shown = floatsOf(renderJson(scene, spec.dump()));
  EXPECT_LT(std::count(shown.begin(), shown.end(), 0.0f), 20) << "edges, where some are missed";
  spec["shadow"]["technique"] = "rayTraced";
  const auto traced = floatsOf(renderJson(scene, spec.dump()));
  EXPECT_GT(std::count(traced.begin(), traced.end(), 0.0f), 100);
}

TEST(ShadowVolumeCasters, D2_NodesCastAndReceiveAsTheyAreTold) {
  // A box half sunk into the floor: its inside counts only where it is not seen.
  testing::GlbBuilder builder = boxOverFloor();
  builder.json["nodes"][1]["translation"] = {0, 0.3, 0};
  builder.addRoot(placed(0, {-4, 1.2, 0}, {0.6, 0.6, 0.6}));
  const ScenePtr scene = testing::sceneOf(builder);
  for (const Json& light : {testLights().sun, testLights().point}) {
    for (const Json& nodes : Json::parse(R"([
        [{"node":1,"visible":false,"castShadow":true}], [{"node":1,"castShadow":false}], [{"node":1,"visible":false}],
        [{"node":2,"receiveShadow":false}], [{"node":1,"layers":2}]])")) {
      Json spec = volumeSpec(light, usualCamera());
      spec["nodes"] = nodes;
      const Difference found = difference(scene, spec);
      EXPECT_GT(found.shadowed, 100u) << nodes;
      EXPECT_EQ(found.elsewhere, 0u) << nodes << light;
    }
    Json layered = volumeSpec(light, usualCamera());
    layered["lights"][0]["cullingMask"] = 1;
    layered["nodes"] = {{{"node", 1}, {"layers", 2}}};
    EXPECT_EQ(difference(scene, layered).elsewhere, 0u);
  }
}

TEST(ShadowVolumeCasters, G2_MaskedCastersAreRefusedByName) {
  const ScenePtr scene = generatedScene("mask_leaf");
  Json spec = volumeSpec(testLights().sun, {{"node", "camera"}});
  const Problems problems = testing::refusedJson(scene, spec.dump());
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].code, ProblemCode::unsupportedFeature);
  EXPECT_EQ(problems[0].pointer, "/shadow/technique");
  EXPECT_THAT(problems[0].detail, ::testing::HasSubstr("leaf"));

  Json own = spec;
  own["shadow"]["technique"] = "shadowMap";
  own["lights"][0]["shadow"] = {{"technique", "shadowVolume"}};
  EXPECT_EQ(testing::refusedJson(scene, own.dump())[0].pointer, "/lights/0/shadow/technique");

  spec["nodes"] = {{{"node", "leaf"}, {"castShadow", false}}};
  EXPECT_EQ(renderJson(scene, spec.dump()).images.size(), 1u);
  const Problems blended = testing::refusedJson(generatedScene("blended_pane"), own.dump());
  EXPECT_EQ(blended[0].code, ProblemCode::unsupportedFeature);
}

} // namespace
} // namespace gnomon
