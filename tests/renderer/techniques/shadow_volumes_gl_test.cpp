// Technique shadowVolume: held against rays and against closed forms, one trap after another.
#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>
#include <random>

#include "tests/renderer/techniques/traced_frame.h"

namespace gnomon {
namespace {

using testing::floatsOf;
using testing::generatedScene;
using testing::renderJson;
using testing::truthOf;

Json specOf(const Json& light, const Json& camera) {
  return {{"width", 240},
          {"height", 160},
          {"camera", camera},
          {"lights", {light}},
          {"shadow", {{"technique", "shadowVolume"}}},
          {"antialiasing", "none"},
          {"views", {"shadow"}},
          {"output", {{"format", "exr"}}}};
}

Json cameraFrom(const Json& eye, const Json& target) {
  return {{"eye", eye}, {"target", target}, {"up", {0.05, 1, 0.02}}};
}

const Json kSun = Json::parse(R"({"type":"directional","direction":[0.5,-1,-0.3]})");
const Json kLowSun = Json::parse(R"({"type":"directional","direction":[0.9,-0.15,-0.5]})");
const Json kVertical = Json::parse(R"({"type":"directional","direction":[0,-1,0]})");
const Json kPoint = Json::parse(R"({"type":"point","position":[-1.7,4.3,2.1],"intensity":300})");
const Json kSpot = Json::parse(
    R"({"type":"spot","position":[-2.1,5.3,3.2],"direction":[0.4,-1,-0.5],"outerConeDegrees":60,"intensity":300})");

/// Receivers on which a frame and the rays disagree: within a pixel of an edge of what the rays say, and elsewhere.
struct Difference {
  std::size_t receivers = 0;
  std::size_t shadowed = 0;
  std::size_t atEdges = 0;
  std::size_t elsewhere = 0;
};

bool atEdge(const std::vector<float>& truth, int width, int height, int x, int y) {
  const auto at = [&](int column, int row) {
    return truth[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) + static_cast<std::size_t>(column)] >=
           0.5f;
  };
  for (int row = std::max(0, y - 1); row <= std::min(height - 1, y + 1); ++row) {
    for (int column = std::max(0, x - 1); column <= std::min(width - 1, x + 1); ++column) {
      if (at(column, row) != at(x, y)) return true;
    }
  }
  return false;
}

Difference differenceFrom(const LightReference& truth, const std::vector<float>& shown, int width, int height) {
  Difference difference;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const auto i = static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
      if (truth.receiver[i] == 0) continue;
      ++difference.receivers;
      const bool lit = truth.visibility[i] >= 0.5f;
      if (!lit) ++difference.shadowed;
      if (lit == (shown[i] >= 0.5f)) continue;
      ++(atEdge(truth.visibility, width, height, x, y) ? difference.atEdges : difference.elsewhere);
    }
  }
  return difference;
}

Difference difference(const ScenePtr& scene, const Json& spec) {
  const std::vector<float> shown = floatsOf(renderJson(scene, spec.dump()));
  return differenceFrom(truthOf(scene, spec.dump()), shown, spec["width"].get<int>(), spec["height"].get<int>());
}

/// No pixel off the edges of the shadows differs from what rays say, and there is a shadow to be seen.
void expectTruth(const ScenePtr& scene, const Json& spec) {
  const Difference found = difference(scene, spec);
  EXPECT_GT(found.shadowed, 20u) << spec["lights"] << spec["camera"];
  EXPECT_GT(found.receivers - found.shadowed, 20u) << spec["lights"] << spec["camera"];
  EXPECT_EQ(found.elsewhere, 0u) << spec["lights"] << spec["camera"];
  // On edges a pixel's centre may lie as near to the edge as a sample's place is known: 1/256 of a pixel.
  EXPECT_LE(found.atEdges, 2 + found.receivers / 2000) << spec["lights"] << spec["camera"];
}

nlohmann::json placed(int mesh, const Json& translation, const Json& scale) {
  return nlohmann::json::parse(Json{{"mesh", mesh}, {"translation", translation}, {"scale", scale}}.dump());
}

/// A cube of 2 m at the origin of its node (mesh 0), and a square of 2 m that faces up (mesh 1); no node yet.
testing::GlbBuilder shapes() {
  testing::GlbBuilder builder = testing::cube();
  builder.json["nodes"] = nlohmann::json::array();
  builder.json["scenes"][0]["nodes"] = nlohmann::json::array();
  const int position = builder.addPoints({{-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}});
  const int normal = builder.addPoints({{0, 1, 0}, {0, 1, 0}, {0, 1, 0}, {0, 1, 0}});
  builder.addMesh({{"attributes", {{"POSITION", position}, {"NORMAL", normal}}},
                   {"indices", builder.addShortIndices({0, 1, 2, 0, 2, 3})}});
  return builder;
}

/// A box of 2 m that floats 0.5 m over a floor of 40 m: nodes 1 and 0.
testing::GlbBuilder boxOverFloor() {
  testing::GlbBuilder builder = shapes();
  builder.addRoot(placed(1, {0, 0, 0}, {20, 1, 20}));
  builder.addRoot(placed(0, {0, 1.5, 0}, {1, 1, 1}));
  return builder;
}

const Json kEye = cameraFrom({6, 5, 8}, {0, 0.5, 0});

class AgainstRays : public ::testing::TestWithParam<const char*> {};

TEST_P(AgainstRays, N7_NoPixelOffTheEdgesDiffers) {
  const ScenePtr scene = generatedScene(GetParam());
  std::size_t receivers = 0;
  std::size_t atEdges = 0;
  for (const Json& light : {kSun, kLowSun, kPoint, kSpot}) {
    const Difference found = difference(scene, specOf(light, {{"node", "camera"}}));
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
  Json spec = specOf(light, {{"eye", {0, 20, 0}},
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

TEST(ShadowVolumes, N3_TheCameraMayStandInsideAVolume) {
  const ScenePtr scene = testing::sceneOf(boxOverFloor());
  for (const Json& light : {kSun, kVertical, kPoint, kSpot}) {
    // Under the box, where every light is hidden, and looking out.
    expectTruth(scene, specOf(light, cameraFrom({0.1, 0.3, -0.05}, {3, 0.1, -2})));
    expectTruth(scene, specOf(light, cameraFrom({0.3, 0.2, -0.3}, {-2, 0, 1})));
  }
}

TEST(ShadowVolumes, N3_TheCameraMayStandInsideACaster) {
  // A box that reaches into the floor; seen from inside of it, its own faces are culled, and its inside is dark.
  testing::GlbBuilder builder = boxOverFloor();
  builder.json["nodes"][1]["translation"] = {0, 0.5, 0};
  const ScenePtr scene = testing::sceneOf(builder);
  for (const Json& light : {kSun, kPoint}) {
    expectTruth(scene, specOf(light, cameraFrom({0.2, 0.9, 0.1}, {2, 0, -1})));
  }
}

TEST(ShadowVolumes, N3_TheNearPlaneMayCutVolumesAndCasters) {
  const ScenePtr scene = testing::sceneOf(boxOverFloor());
  for (const double near : {1e-4, 5.0, 9.0, 10.5}) {
    for (const Json& light : {kSun, kLowSun, kPoint}) {
      Json spec = specOf(light, kEye);
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
    for (const Json& light : {kSun, kLowSun, back, kPoint}) {
      Json spec = specOf(light, kEye);
      spec["camera"]["perspective"] = {{"fovYDegrees", 50}, {"near", 0.1}};
      if (!far.is_null()) spec["camera"]["perspective"]["far"] = far;
      expectTruth(scene, spec);
    }
  }
}

TEST(ShadowVolumes, N3_OpenMeshesDoNotShadowThemselves) {
  for (const double degrees : {0.0, 20.0, 45.0, 75.0, 89.0}) {
    testing::GlbBuilder builder = testing::plane();
    const double half = degrees * 3.14159265358979 / 360;
    builder.json["nodes"][0]["rotation"] = {std::sin(half), 0, 0, std::cos(half)};
    builder.json["nodes"][0]["scale"] = {10, 10, 10};
    const ScenePtr scene = testing::sceneOf(builder);
    const double angle = 2 * half;
    for (const Json& light : {kVertical, Json{{"type", "point"}, {"position", {1, 8, 2}}}}) {
      for (const double far : {8.0, 1e4}) { // the plane reaches behind the first one
        Json spec = specOf(light, cameraFrom({1.7, std::cos(angle) * 15 - std::sin(angle) * 4,
                                              std::sin(angle) * 15 + std::cos(angle) * 4},
                                             {0, 0, 0}));
        spec["camera"]["perspective"] = {{"fovYDegrees", 60}, {"near", 1e-3}, {"far", far + 8}};
        const auto shown = floatsOf(renderJson(scene, spec.dump()));
        EXPECT_EQ(std::count(shown.begin(), shown.end(), 1.0f), std::ssize(shown)) << degrees << ' ' << far << light;
      }
    }
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

TEST(ShadowVolumes, N3_OpenAndNonManifoldMeshesThrowTheirShadows) {
  std::mt19937 random(20);
  for (int i = 0; i < 4; ++i) {
    const ScenePtr scene = testing::sceneOf(soup(random, 30));
    for (const Json& light : {kSun, kLowSun, kPoint, kSpot}) {
      const Difference found = difference(scene, specOf(light, kEye));
      EXPECT_GT(found.shadowed, 100u);
      EXPECT_EQ(found.elsewhere, 0u) << i << light;
      EXPECT_LE(found.atEdges, 2 + found.receivers / 1000) << i << light;
    }
  }
}

TEST(ShadowVolumes, G4_NodesMayMirrorShearAndFlatten) {
  testing::GlbBuilder builder = boxOverFloor();
  builder.json["nodes"][1]["scale"] = {-1, 0.7, 1.2};
  // Turned, scaled unevenly, turned again: a shear.
  nlohmann::json inner = {{"mesh", 0}, {"rotation", {0, 0, 0.3826834, 0.9238795}}};
  builder.json["nodes"].push_back(inner);
  builder.addRoot({{"children", {2}}, {"scale", {1.5, 0.4, 0.6}}, {"translation", {-3.5, 1.2, -1}}});
  builder.addRoot(placed(0, {3, 1.5, -2}, {0.8, 0, 0.8}));
  const ScenePtr scene = testing::sceneOf(builder);
  for (const Json& light : {kSun, kLowSun, kPoint, kSpot}) expectTruth(scene, specOf(light, kEye));
}

/// Cards of 2 m over a floor, one above the other, from 1 m upwards.
ScenePtr stack(int cards) {
  testing::GlbBuilder builder = shapes();
  builder.addRoot(placed(1, {0, 0, 0}, {20, 1, 20}));
  for (int i = 0; i < cards; ++i) builder.addRoot(placed(1, {0, 1 + 1e-4 * i, 0}, {1, 1, 1}));
  return testing::sceneOf(builder);
}

TEST(ShadowVolumes, N3_CountsWrapRoundAndBack) {
  for (const int cards : {255, 257, 300}) {
    const ScenePtr scene = stack(cards);
    // From outside, from under the cards, and from between them.
    expectTruth(scene, specOf(kVertical, kEye));
    expectTruth(scene, specOf(kSun, kEye));
    expectTruth(scene, specOf(kSun, cameraFrom({0.1, 0.4, 0.2}, {2, 0, -2})));
    Json between = specOf(kSun, cameraFrom({0.1, 1.01505, 0.2}, {3, 0.9, -2}));
    between["camera"]["perspective"] = {{"fovYDegrees", 60}, {"near", 1e-5}};
    const Difference found = difference(scene, between);
    EXPECT_EQ(found.elsewhere, 0u) << cards;
  }
}

TEST(ShadowVolumes, N3_256VolumesAtOnceAreTheLimit) {
  // Eight bits can't tell 256 from none: what the README's limitations say.
  const ScenePtr scene = stack(256);
  Json spec = specOf(kVertical, cameraFrom({3, 0.5, 3}, {0, 0, 0}));
  const auto shown = floatsOf(renderJson(scene, spec.dump()));
  EXPECT_LT(std::count(shown.begin(), shown.end(), 0.0f), 20) << "edges, where some are missed";
  spec["shadow"]["technique"] = "rayTraced";
  const auto traced = floatsOf(renderJson(scene, spec.dump()));
  EXPECT_GT(std::count(traced.begin(), traced.end(), 0.0f), 100);
}

TEST(ShadowVolumes, N3_ALightMayStandInTheMiddleOfTheScene) {
  testing::GlbBuilder builder = boxOverFloor();
  builder.addRoot(placed(0, {-3, 0.6, 2}, {0.5, 0.5, 0.5}));
  builder.addRoot(placed(0, {2.5, 1, -3}, {0.4, 1, 0.4}));
  const ScenePtr scene = testing::sceneOf(builder);
  for (const Json& position : Json{{-1.6, 0.7, 0.4}, {1.5, 0.2, -1.6}, {0, 0.25, 0}, {0, 2.5001, 0}}) {
    const Json point = {{"type", "point"}, {"position", position}};
    const Json spot = {
        {"type", "spot"}, {"position", position}, {"direction", {-0.6, -0.2, 0.7}}, {"outerConeDegrees", 85}};
    for (const Json& light : {point, spot}) {
      const Difference found = difference(scene, specOf(light, kEye));
      EXPECT_EQ(found.elsewhere, 0u) << light;
      EXPECT_LE(found.atEdges, 2 + found.receivers / 1000) << light;
    }
  }
}

TEST(ShadowVolumes, N3_ALightInsideACasterLightsNothingOutside) {
  const ScenePtr scene = testing::sceneOf(boxOverFloor());
  const Json light = {{"type", "point"}, {"position", {0.2, 1.4, -0.3}}};
  const Difference found = difference(scene, specOf(light, kEye));
  EXPECT_EQ(found.elsewhere + found.atEdges, 0u);
  EXPECT_GT(found.receivers, 10000u);
  EXPECT_EQ(found.shadowed, found.receivers);
}

TEST(ShadowVolumes, M3_LightsAtAndNearTheVerticalAreExact) {
  const ScenePtr scene = testing::sceneOf(boxOverFloor());
  for (const double tilt : {0.0, 1e-9, -1e-7, 1e-5, -1e-3, 1e-2}) {
    expectTruth(scene, specOf({{"type", "directional"}, {"direction", {tilt, -1, 0.3 * tilt}}}, kEye));
  }
}

TEST(ShadowVolumes, G5_AnOrthographicCameraMayLookAlongTheLight) {
  const ScenePtr scene = testing::sceneOf(boxOverFloor());
  Json camera = {{"eye", {-5, 10, 3}},
                 {"target", {0, 0, 0}},
                 {"up", {0, 1, 0}},
                 {"orthographic", {{"height", 14}, {"near", 0}, {"far", 40}}}};
  for (const Json& light : {kLowSun, kPoint, kSpot}) expectTruth(scene, specOf(light, camera));
  for (const double tilt : {0.0, 1e-9, 1e-7, 1e-4, 1e-2}) {
    // With the view, no shadow can be seen, and against it every point seen under the box is in it.
    const Json with = {{"type", "directional"}, {"direction", {5 + tilt, -10, -3}}};
    const Difference none = difference(scene, specOf(with, camera));
    EXPECT_EQ(none.elsewhere, 0u) << tilt;
    EXPECT_LE(none.shadowed, 200u) << tilt;
    const Json under = {{"eye", {5, -10, -3}},
                        {"target", {0, 0, 0}},
                        {"up", {0, 1, 0}},
                        {"orthographic", {{"height", 14}, {"near", 0}, {"far", 40}}}};
    EXPECT_EQ(difference(scene, specOf(with, under)).elsewhere, 0u) << tilt;
  }
}

TEST(ShadowVolumes, N3_EverySampleOfAPixelHasItsOwnAnswer) {
  const ScenePtr scene = testing::sceneOf(boxOverFloor());
  Json spec = specOf(kSun, kEye);
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

TEST(ShadowVolumes, D2_NodesCastAndReceiveAsTheyAreTold) {
  // A box half sunk into the floor: its inside counts only where it is not seen.
  testing::GlbBuilder builder = boxOverFloor();
  builder.json["nodes"][1]["translation"] = {0, 0.3, 0};
  builder.addRoot(placed(0, {-4, 1.2, 0}, {0.6, 0.6, 0.6}));
  const ScenePtr scene = testing::sceneOf(builder);
  for (const Json& light : {kSun, kPoint}) {
    for (const Json& nodes : Json::parse(R"([
        [{"node":1,"visible":false,"castShadow":true}], [{"node":1,"castShadow":false}], [{"node":1,"visible":false}],
        [{"node":2,"receiveShadow":false}], [{"node":1,"layers":2}]])")) {
      Json spec = specOf(light, kEye);
      spec["nodes"] = nodes;
      const Difference found = difference(scene, spec);
      EXPECT_GT(found.shadowed, 100u) << nodes;
      EXPECT_EQ(found.elsewhere, 0u) << nodes << light;
    }
    Json layered = specOf(light, kEye);
    layered["lights"][0]["cullingMask"] = 1;
    layered["nodes"] = {{{"node", 1}, {"layers", 2}}};
    EXPECT_EQ(difference(scene, layered).elsewhere, 0u);
  }
}

TEST(ShadowVolumes, G2_MaskedCastersAreRefusedByName) {
  const ScenePtr scene = generatedScene("mask_leaf");
  Json spec = specOf(kSun, {{"node", "camera"}});
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

TEST(ShadowVolumes, H12_AMillionMetresFromTheOriginTheyAreTheSame) {
  const auto movedTo = [](const Json& light, double away) {
    testing::GlbBuilder builder = boxOverFloor();
    for (auto& node : builder.json["nodes"]) {
      auto& translation = node["translation"];
      for (auto& each : translation) each = each.get<double>() + away;
    }
    Json spec = specOf(light, kEye);
    for (const char* const point : {"eye", "target"}) {
      for (auto& each : spec["camera"][point]) each = each.get<double>() + away;
    }
    if (light.contains("position")) {
      for (auto& each : spec["lights"][0]["position"]) each = each.get<double>() + away;
    }
    return floatsOf(renderJson(testing::sceneOf(builder), spec.dump()));
  };
  for (const Json& light : {kSun, kPoint}) {
    const auto here = movedTo(light, 0);
    const auto there = movedTo(light, 1048576);
    std::size_t different = 0;
    for (std::size_t i = 0; i < here.size(); ++i) different += here[i] != there[i] ? 1 : 0;
    EXPECT_LE(different, here.size() / 10000) << light;
  }
}

TEST(ShadowVolumes, DegenerateTrianglesChangeNothing) {
  // A cube with triangles of no area among the others: corners at one place, and corners on one line.
  testing::GlbBuilder builder = boxOverFloor();
  const ScenePtr plain = testing::sceneOf(builder);
  const auto count = builder.json["accessors"][2]["count"].get<std::size_t>();
  std::vector<std::uint16_t> indices(count);
  const auto view = builder.json["accessors"][2]["bufferView"].get<std::size_t>();
  const auto offset = builder.json["bufferViews"][view]["byteOffset"].get<std::size_t>();
  std::memcpy(indices.data(), builder.binary.data() + offset, count * sizeof(std::uint16_t));
  for (const int i : {0, 0, 1, 5, 5, 5, 0, 1, 0}) indices.push_back(static_cast<std::uint16_t>(i));
  builder.json["meshes"][0]["primitives"][0]["indices"] = builder.addShortIndices(indices);
  const ScenePtr degenerate = testing::sceneOf(builder);
  for (const Json& light : {kSun, kPoint}) {
    const Json spec = specOf(light, kEye);
    EXPECT_EQ(floatsOf(renderJson(plain, spec.dump())), floatsOf(renderJson(degenerate, spec.dump())));
  }
}

} // namespace
} // namespace gnomon
