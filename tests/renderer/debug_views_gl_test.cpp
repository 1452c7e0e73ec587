// What the views of one light's texels show, held against what can be worked out without them.
#include <cmath>

#include "protocol/json/json_codec.h"
#include "renderer/shadow/filter_kernel.h"
#include "tests/renderer/frame_fixture.h"
#include "tests/support/tested_device.h"

namespace gnomon {
namespace {

using testing::floatsOf;
using testing::renderJson;
using testing::valueAt;

/// A ground of 40 m at y = 0.
testing::GlbBuilder ground() {
  testing::GlbBuilder builder = testing::plane();
  builder.json["nodes"][0]["scale"] = {20, 1, 20};
  return builder;
}

/// Straight down on 10 m of it, 10 pixels a metre, -Z upwards.
Json fromAbove(const std::vector<std::string>& views, const Json& light) {
  return {
      {"width", 100},
      {"height", 100},
      {"camera", {{"eye", {0, 8, 0}}, {"target", {0, 0, 0}}, {"up", {0, 0, -1}}, {"orthographic", {{"height", 10}}}}},
      {"lights", {light}},
      {"shadow", {{"cascadeCount", 1}}},
      {"antialiasing", "none"},
      {"views", views},
      {"output", {{"format", "exr"}, {"exrPixelType", "float"}}}};
}

const Json kNoon = {{"type", "directional"}, {"direction", {0, -1, 0}}};
const Json kSlanted = {{"type", "directional"}, {"direction", {1, -1, 0}}};
const Json kStable = {{"mode", "manual"}, {"min", 0}, {"max", 20}};

TEST(DebugViews, H9_TexelDensityIsAsManyPixelsAsATexelSpans) {
  const ScenePtr scene = testing::sceneOf(ground());
  std::vector<float> centres;
  for (const char* size : {"Large", "XLarge"}) {
    Json spec = fromAbove({"texelDensity"}, kNoon);
    spec["width"] = spec["height"] = 400;
    spec["shadow"]["size"] = size;
    const Frame frame = renderJson(scene, spec.dump());
    // 400 pixels lie in the tile but for its border and the bias's room.
    const int texels = frame.report.lights[0].grantedTileSize;
    centres.push_back(valueAt(frame, 0.5, 0.5));
    EXPECT_GE(centres.back(), 400.0 / texels);
    EXPECT_LE(centres.back(), 400.0 / (texels - 20));
    EXPECT_NEAR(valueAt(frame, 0.1, 0.9), centres.back(), 1e-3) << "the same everywhere";
  }
  EXPECT_NEAR(centres[0] / centres[1], 2.0, 0.05) << "a tile twice as wide has texels half as large";
}

TEST(DebugViews, H9_ASlantStretchesTexelsByItsCosine) {
  Json spec = fromAbove({"texelDensity"}, kSlanted);
  spec["shadow"]["depthRange"] = kStable;
  spec["shadow"]["stabilization"] = "projectionSnapping"; // square texels
  const Frame frame = renderJson(testing::sceneOf(ground()), spec.dump());
  const double texel = frame.report.lights[0].tiles.at(0).texelSize[0];
  EXPECT_NEAR(valueAt(frame, 0.5, 0.5), 10 * texel * std::sqrt(2.0), 1e-3 * texel);
}

TEST(DebugViews, H9_TexelDensityFollowsThePictureSPerspective) {
  Json spec = fromAbove({"texelDensity"}, kNoon);
  spec["camera"] = {{"eye", {0, 8, 0}}, {"up", {0, 0, -1}}, {"perspective", {{"fovYDegrees", 60}}}};
  spec["shadow"]["depthRange"] = kStable;
  spec["shadow"]["stabilization"] = "projectionSnapping";
  const Frame frame = renderJson(testing::sceneOf(ground()), spec.dump());
  const double texel = frame.report.lights[0].tiles.at(0).texelSize[0];
  const double pixels = 100 / (2 * 8 * std::tan(3.14159265358979 / 6)); // a metre of ground
  EXPECT_NEAR(valueAt(frame, 0.5, 0.5), pixels * texel, 1e-3 * pixels * texel);
  EXPECT_NEAR(valueAt(frame, 0.05, 0.95), pixels * texel, 1e-3 * pixels * texel) << "one depth, one scale";
}

TEST(DebugViews, H9_TexelsOfASpotGrowWithTheDistanceFromIt) {
  const Json spot = {{"type", "spot"}, {"position", {0, 5, 0}}, {"direction", {0, -1, 0}}, {"outerConeDegrees", 30}};
  testing::GlbBuilder scene = ground();
  scene.addRoot({{"mesh", 0}, {"translation", {-1.5, 2.5, 0}}}); // 2 m across, halfway up
  const Frame frame = renderJson(testing::sceneOf(scene), fromAbove({"texelDensity"}, spot).dump());
  const TileReport& face = frame.report.lights[0].tiles.at(0);
  const double tangent = std::max(face.texelSize[0], face.texelSize[1]) / face.far;
  EXPECT_NEAR(valueAt(frame, 0.6, 0.5), 10 * 5 * tangent, 1e-2 * 50 * tangent) << "on the ground";
  EXPECT_NEAR(valueAt(frame, 0.4, 0.5), 10 * 2.5 * tangent, 1e-2 * 25 * tangent) << "on the plate";
  EXPECT_EQ(valueAt(frame, 0.02, 0.02), 0.0f) << "outside of the cone there are no texels";
}

TEST(DebugViews, H9_GrazingLightGivesFiniteNumbers) {
  const ScenePtr scene = testing::sceneOf(ground());
  for (const double down : {0.0, 1e-7, 1e-3}) {
    const Json light = {{"type", "directional"}, {"direction", {1, -down, 0}}};
    const Frame frame = renderJson(scene, fromAbove({"texelDensity", "bias", "texelGrid"}, light).dump());
    for (const std::size_t view : {0u, 1u, 2u}) {
      for (const float value : floatsOf(frame, view)) ASSERT_TRUE(std::isfinite(value) && value <= 65504.0f) << down;
    }
  }
}

TEST(DebugViews, H9_TheTexelGridHasASquareForEachTexel) {
  Json spec = fromAbove({"texelGrid"}, kNoon);
  spec["width"] = spec["height"] = 1000;
  spec["shadow"]["size"] = "XSmall";
  const Frame frame = renderJson(testing::sceneOf(ground()), spec.dump());
  const auto& texel = frame.report.lights[0].tiles.at(0).texelSize; // its axes are the picture's
  const auto row = floatsOf(frame).begin() + 505 * 1000 * 3;
  float darkest = row[1];
  float lightest = row[1];
  for (int column = 0; column < 1000; ++column) {
    darkest = std::min(darkest, row[column * 3 + 1]);
    lightest = std::max(lightest, row[column * 3 + 1]);
  }
  EXPECT_GT(lightest, 3 * darkest) << "the squares can be told apart";
  const float middle = 0.5f * (darkest + lightest);
  int edges = 0;
  for (int column = 1; column < 1000; ++column) {
    edges += (row[column * 3 + 1] > middle) != (row[column * 3 - 2] > middle);
  }
  EXPECT_NEAR(edges, 10.0 / texel[0], 1.0);
  EXPECT_NEAR(texel[0], texel[1], 0.01 * texel[0]) << "whichever of them lies across";
}

TEST(DebugViews, X15_BlendWeightRisesFromNoneToAllAcrossASplit) {
  Json spec = fromAbove({"depth", "blendWeight"}, kSlanted);
  // A split at 10.5 m, blended over the last fifth of the 10 m before it.
  spec["camera"] = {{"eye", {0, 1.5, 19}}, {"target", {0, 0, 9}}, {"perspective", {{"near", 0.5}}}};
  spec["shadow"]["cascadeCount"] = 2;
  spec["shadow"]["depthRange"] = kStable;
  spec["shadow"]["partition"] = {{"mode", "manual"}, {"splits", {0.5, 1}}};
  const ScenePtr scene = testing::sceneOf(ground());
  const Frame frame = renderJson(scene, spec.dump());
  const auto& depths = floatsOf(frame, 0);
  const auto& weights = floatsOf(frame, 1);
  int between = 0;
  for (std::size_t i = 0; i < depths.size(); ++i) {
    const double t = std::clamp((depths[i] - 8.5) / 2.0, 0.0, 1.0);
    if (std::abs(depths[i] - 10.5f) < 1e-3f) continue; // either side of the split
    const double expected = depths[i] < 10.5f ? t * t * (3 - 2 * t) : 0.0;
    ASSERT_NEAR(weights[i], expected, 1e-3) << depths[i];
    between += weights[i] > 0.05f && weights[i] < 0.95f;
  }
  EXPECT_GT(between, 100);

  spec["shadow"]["blendCascades"] = false;
  const Frame hard = renderJson(scene, spec.dump());
  for (const float weight : floatsOf(hard, 1)) ASSERT_EQ(weight, 0.0f);
}

TEST(DebugViews, H4_BiasIsTheOffsetThatThePlanAsksFor) {
  const ScenePtr scene = testing::sceneOf(ground());
  for (const char* text : {R"({"type":"hard"})", R"({"type":"pcf","size":7})"}) {
    Json spec = fromAbove({"bias"}, kSlanted);
    spec["shadow"]["filter"] = Json::parse(text);
    const Frame frame = renderJson(scene, spec.dump());
    const auto& texel = frame.report.lights[0].tiles.at(0).texelSize;
    // Along the normal, and towards the light the room for a bend by 0.1: tan(45 degrees + 0.1) is about 1.2.
    const double along = kBiasReach * std::hypot(texel[0], texel[1]) * std::sqrt(0.5);
    const auto expected = [&](double size) {
      const double room = 0.2 * size;
      return std::sqrt(along * along + room * room + 2 * along * room * std::sqrt(0.5));
    };
    EXPECT_GT(valueAt(frame, 0.5, 0.5), 0.5 * expected(texel[0])) << text;
    EXPECT_LT(valueAt(frame, 0.5, 0.5), 1.5 * expected(texel[1])) << text;
  }
  // Along the normal nothing needs to be moved but for rounding and bends.
  const Frame noon = renderJson(scene, fromAbove({"bias"}, kNoon).dump());
  EXPECT_LT(valueAt(noon, 0.5, 0.5), 0.11 * noon.report.lights[0].tiles.at(0).texelSize[0] + 1e-3);
}

TEST(DebugViews, AManualBiasIsShownAsItIsAsked) {
  const ScenePtr scene = testing::sceneOf(ground());
  const auto shown = [&](const Json& bias) {
    Json spec = fromAbove({"bias"}, kSlanted); // 45 degrees: a tangent of 1
    spec["shadow"]["bias"] = bias;
    spec["shadow"]["bias"]["mode"] = "manual";
    return valueAt(renderJson(scene, spec.dump()), 0.5, 0.5);
  };
  EXPECT_NEAR(shown({{"depth", 0.05}}), 0.05, 5e-4);
  EXPECT_NEAR(shown({{"depth", 0.05}, {"slope", 0.02}}), 0.07, 5e-4);
  // 0.05 m towards the light and 0.1 m along the normal, 45 degrees apart.
  EXPECT_NEAR(shown({{"depth", 0.05}, {"normalOffsetScale", 2}}), std::sqrt(0.0125 + 0.01 * std::sqrt(0.5)), 5e-4);
}

TEST(DebugViews, H4_ASpotMovesAPointByItsDistance) {
  // 45 degrees to the ground, which it meets 4 m away along its axis at the origin.
  const double high = 4 * std::sqrt(0.5);
  const Json spot = {
      {"type", "spot"}, {"position", {-high, high, 0}}, {"direction", {1, -1, 0}}, {"outerConeDegrees", 30}};
  const Frame frame = renderJson(testing::sceneOf(ground()), fromAbove({"bias"}, spot).dump());
  const TileReport& face = frame.report.lights[0].tiles.at(0);
  const glm::dvec2 tangents(face.texelSize[0] / face.far, face.texelSize[1] / face.far);
  const double along = 4 * punctualNormalOffset(kBiasReach, tangents) * std::sqrt(0.5);
  const double room = 4 * 0.2 * tangents.x;
  const double expected = std::sqrt(along * along + room * room + 2 * along * room * std::sqrt(0.5));
  EXPECT_NEAR(valueAt(frame, 0.501, 0.501), expected, 0.15 * expected);
}

/// Plates of 1 m, 1 m above the ground, as nodes 3 and 2054; their shadows fall 1 m towards +Z.
testing::GlbBuilder twoPlates() {
  testing::GlbBuilder builder = ground();
  const auto plate = [&](double x) {
    builder.addRoot({{"mesh", 0}, {"translation", {x, 1, -2}}, {"scale", {0.5, 0.5, 0.5}}});
  };
  builder.addRoot({{"name", "nothing"}});
  builder.addRoot({{"name", "nothing"}});
  plate(-3);
  for (int i = 0; i < 2050; ++i) builder.addRoot({{"name", "nothing"}});
  plate(3);
  return builder;
}

TEST(DebugViews, H9_CastersAreNamedInTheFacesOfAPointLight) {
  // 1 m above the plates: they shadow the ground from 5 to 7 m on either side.
  Json spec = fromAbove({"casterIds"}, {{"type", "point"}, {"position", {0, 2, -2}}});
  spec["width"] = spec["height"] = 400;
  spec["shadow"]["size"] = "XLarge";                                // so that no bias lifts the ground over the plates
  const double half = std::atan(10.0 / 8) * 180 / 3.14159265358979; // 20 m of ground
  spec["camera"] = {{"eye", {0, 8, 0}}, {"up", {0, 0, -1}}, {"perspective", {{"fovYDegrees", 2 * half}}}};
  const Frame frame = renderJson(testing::sceneOf(twoPlates()), spec.dump());
  EXPECT_EQ(valueAt(frame, 0.5 - 6.0 / 20, 0.5 - 2.0 / 20), 3.0f);
  EXPECT_EQ(valueAt(frame, 0.5 + 6.0 / 20, 0.5 - 2.0 / 20), 2054.0f);
  EXPECT_EQ(valueAt(frame, 0.5, 0.5 - 2.0 / 20), -1.0f) << "under the light";
  EXPECT_EQ(valueAt(frame, 0.5 - 6.0 / 20, 0.5 + 2.0 / 20), -1.0f) << "beside";
}

/// Techniques that need no map: rays say who throws the shadow.
const char* const kByRays[] = {"rayTraced", "lightMap"};

/// Where `shadow` (view 1) is full a node is named, and none where all light arrives; gives how many pixels show
/// `node`.
std::size_t pixelsNaming(const Frame& frame, float node) {
  const auto& ids = floatsOf(frame, 0);
  const auto& visibility = floatsOf(frame, 1);
  std::size_t naming = 0;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    naming += ids[i] == node;
    if (visibility[i] > 0.0f && visibility[i] < 1.0f) continue; // an edge, or between texels of a light map
    EXPECT_EQ(ids[i] >= 0.0f, visibility[i] == 0.0f) << "pixel " << i << " names " << ids[i];
    if (::testing::Test::HasFailure()) return 0;
  }
  return naming;
}

TEST(DebugViews, H9_CasterIdsNameTheNodesThatThrowTheShadows) {
  const Json light = {{"type", "directional"}, {"direction", {0, -1, 1}}};
  const ScenePtr scene = testing::sceneOf(twoPlates());
  std::vector<const char*> techniques{"shadowMap", "rayTraced", "lightMap"};
  if (testing::testedDevice() == DeviceChoice::gl) techniques.push_back("shadowVolume");
  for (const char* technique : techniques) {
    SCOPED_TRACE(technique);
    Json spec = fromAbove({"casterIds", "shadow"}, light);
    spec["shadow"]["technique"] = technique;
    const Frame frame = renderJson(scene, spec.dump());
    EXPECT_EQ(valueAt(frame, 0.2, 0.4), 3.0f);
    EXPECT_EQ(valueAt(frame, 0.8, 0.4), 2054.0f);
    EXPECT_EQ(valueAt(frame, 0.5, 0.4), -1.0f) << "between them";
    EXPECT_EQ(valueAt(frame, 0.2, 0.3), -1.0f) << "on the plate itself";
    EXPECT_EQ(frame.images[0].image.channels, std::vector<std::string>{"id"});
    const auto first = static_cast<double>(pixelsNaming(frame, 3));
    const auto second = static_cast<double>(pixelsNaming(frame, 2054));
    if (std::string(technique) == "shadowMap") continue; // its edges lie anywhere in a texel
    // A metre of each plate's shadow, 10 pixels across, to a pixel of its rim.
    EXPECT_NEAR(first, 100.0, 20.0);
    EXPECT_NEAR(second, 100.0, 20.0);
  }
}

/// A box of 2 m on the ground, as node 1, beside a sun at 35 degrees: what of it is turned away is its own shadow.
TEST(DebugViews, H9_ABoxOnTheGroundThrowsEveryShadow) {
  testing::GlbBuilder scene = ground();
  const auto positions = std::vector<testing::Point>{{-1, 0, -1}, {1, 0, -1}, {1, 2, -1}, {-1, 2, -1},
                                                     {-1, 0, 1},  {1, 0, 1},  {1, 2, 1},  {-1, 2, 1}};
  const int at = scene.addPoints(positions);
  const int indices = scene.addIndices(
      {0, 2, 1, 0, 3, 2, 4, 5, 6, 4, 6, 7, 0, 1, 5, 0, 5, 4, 3, 6, 2, 3, 7, 6, 0, 4, 7, 0, 7, 3, 1, 2, 6, 1, 6, 5});
  scene.addMeshNode(scene.addMesh({{"attributes", {{"POSITION", at}}}, {"indices", indices}}));
  const ScenePtr built = testing::sceneOf(scene);
  for (const char* technique : kByRays) {
    Json spec = fromAbove({"casterIds", "shadow"},
                          {{"type", "directional"}, {"sun", {{"azimuthDegrees", 280}, {"elevationDegrees", 35}}}});
    spec["width"] = 160;
    spec["camera"] = {{"eye", {4, 2, 4}}, {"target", {1, 0, 0}}};
    spec["shadow"]["technique"] = technique;
    EXPECT_GT(pixelsNaming(renderJson(built, spec.dump()), 1), 1000u) << technique;
  }
}

TEST(DebugViews, H9_OfSeveralCastersRaysNameTheNearestToTheLightAsMapsDo) {
  testing::GlbBuilder scene = ground();
  for (const double high : {1.0, 2.0}) {
    scene.addRoot({{"mesh", 0}, {"translation", {0, high, -high}}, {"scale", {0.5, 0.5, 0.5}}});
  }
  const ScenePtr built = testing::sceneOf(scene);
  for (const char* technique : {"shadowMap", "rayTraced"}) {
    Json spec = fromAbove({"casterIds"}, {{"type", "directional"}, {"direction", {0, -1, 1}}});
    spec["shadow"]["technique"] = technique;
    const Frame frame = renderJson(built, spec.dump());
    EXPECT_EQ(valueAt(frame, 0.5, 0.5), 2.0f) << technique;
    EXPECT_EQ(valueAt(frame, 0.5, 0.9), -1.0f) << technique;
  }
}

TEST(DebugViews, H9_RaysNameCastersInTheReachOfALampAlone) {
  Json spec = fromAbove({"casterIds"}, {{"type", "point"}, {"position", {0, 2, -2}}, {"range", 6.2}});
  const double half = std::atan(10.0 / 8) * 180 / 3.14159265358979; // 20 m of ground
  spec["camera"] = {{"eye", {0, 8, 0}}, {"up", {0, 0, -1}}, {"perspective", {{"fovYDegrees", 2 * half}}}};
  spec["shadow"]["technique"] = "rayTraced";
  const Frame frame = renderJson(testing::sceneOf(twoPlates()), spec.dump());
  EXPECT_EQ(valueAt(frame, 0.5 - 5.6 / 20, 0.5 - 2.0 / 20), 3.0f);
  EXPECT_EQ(valueAt(frame, 0.5 + 5.6 / 20, 0.5 - 2.0 / 20), 2054.0f);
  EXPECT_EQ(valueAt(frame, 0.5 + 6.7 / 20, 0.5 - 2.0 / 20), -1.0f) << "behind the plate, out of reach";
  EXPECT_EQ(valueAt(frame, 0.5, 0.5 - 2.0 / 20), -1.0f) << "under the light";
}

TEST(DebugViews, H9_RaysColorCastersAsMapsDo) {
  const Json light = {{"type", "directional"}, {"direction", {0, -1, 1}}};
  const ScenePtr scene = testing::sceneOf(twoPlates());
  const auto bytesOf = [&](const char* technique) {
    Json spec = fromAbove({"casterIds"}, light);
    spec["output"] = {{"format", "png"}};
    spec["shadow"]["technique"] = technique;
    return std::get<std::vector<std::uint8_t>>(renderJson(scene, spec.dump()).images[0].image.pixels);
  };
  const auto mapped = bytesOf("shadowMap");
  const auto traced = bytesOf("rayTraced");
  ASSERT_EQ(mapped.size(), traced.size());
  for (const std::size_t pixel : {40u * 100u + 20u, 40u * 100u + 80u, 40u * 100u + 50u, 30u * 100u + 20u}) {
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(mapped[pixel * 3 + c], traced[pixel * 3 + c], 1) << pixel;
  }
}

} // namespace
} // namespace gnomon
