// Shadows where the triangles of a curved surface turn away from the light: those of the surface that shading shows.
#include <cmath>
#include <gmock/gmock.h>

#include "tests/renderer/frame_fixture.h"
#include "tests/renderer/smooth_mesh.h"

namespace gnomon {
namespace {

using testing::addSheet;
using testing::addSmoothBall;
using testing::addSmoothGrid;
using testing::floatsOf;
using testing::GlbBuilder;
using testing::Point;
using testing::renderJson;
using testing::sceneOf;

/// As the shadow of the light is found: by each filter of a map, by rays, and by both.
std::vector<Json> techniques() {
  std::vector<Json> all{{{"technique", "rayTraced"}}};
  for (const Json& filter : testing::everyFilter()) all.push_back({{"technique", "shadowMap"}, {"filter", filter}});
  return all;
}

const Json kLowSun = {{"sun", {{"azimuthDegrees", 80}, {"elevationDegrees", 15}}}};

/// Of a ball around the origin.
Json specOf(const Json& shadow, const Json& light, const std::vector<std::string>& views) {
  return {{"width", 128},
          {"height", 128},
          {"antialiasing", "none"},
          {"camera", {{"eye", {0, 0.5, 5}}, {"target", {0, 0, 0}}, {"perspective", {{"fovYDegrees", 27}}}}},
          {"lights", {light}},
          {"shadow", shadow},
          {"views", views},
          {"output", {{"format", "exr"}, {"exrPixelType", "float"}}}};
}

Json with(Json shadow, const char* terminator) {
  shadow["terminator"] = terminator;
  return shadow;
}

double cosineAt(const std::vector<float>& normals, std::size_t pixel, const std::array<double, 3>& toLight) {
  double cosine = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) cosine += double{normals[3 * pixel + axis]} * toLight[axis];
  return cosine;
}

/// Toward the sun that `light` is.
std::array<double, 3> towards(const Json& light) {
  const double azimuth = light["sun"]["azimuthDegrees"].get<double>() * std::numbers::pi / 180;
  const double elevation = light["sun"]["elevationDegrees"].get<double>() * std::numbers::pi / 180;
  return {std::cos(elevation) * std::sin(azimuth), std::sin(elevation), -std::cos(elevation) * std::cos(azimuth)};
}

/// Pixels that shading turns to the light by more than 0.1 and that are more than half in shadow; views: shadow,
/// normal.
int blackPixels(const Frame& frame, const std::array<double, 3>& toLight) {
  int black = 0;
  for (std::size_t i = 0; i < floatsOf(frame, 0).size(); ++i) {
    black += cosineAt(floatsOf(frame, 1), i, toLight) > 0.1 && floatsOf(frame, 0)[i] < 0.5f ? 1 : 0;
  }
  return black;
}

ScenePtr ball() {
  GlbBuilder builder;
  builder.addMeshNode(addSmoothBall(builder));
  return sceneOf(builder);
}

TEST(Terminator, NothingThatShadingTurnsToTheSunIsBlack) {
  const ScenePtr scene = ball();
  for (const Json& shadow : techniques()) {
    const Json smooth = specOf(shadow, kLowSun, {"shadow", "normal"});
    EXPECT_EQ(blackPixels(renderJson(scene, smooth.dump()), towards(kLowSun)), 0) << shadow;
    const Json flat = specOf(with(shadow, "flat"), kLowSun, {"shadow", "normal"});
    EXPECT_GT(blackPixels(renderJson(scene, flat.dump()), towards(kLowSun)), 20) << shadow;
  }
}

TEST(Terminator, NorToASoftSunNorToLamps) {
  const ScenePtr scene = ball();
  Json soft = kLowSun;
  soft["angularDiameterDegrees"] = 5;
  const Json lamp = {{"type", "point"}, {"position", {40, 10, -8}}, {"intensity", 5000}};
  const Json spot = {{"type", "spot"}, {"position", {40, 10, -8}}, {"direction", {-40, -10, 8}}};
  const double far = std::sqrt(40.0 * 40 + 10 * 10 + 8 * 8);
  const std::array<double, 3> toLamp{40 / far, 10 / far, -8 / far};
  for (const Json& shadow :
       {Json{{"technique", "rayTraced"}}, Json{{"filter", {{"type", "pcss"}}}}, Json{{"filter", {{"type", "hard"}}}}}) {
    const auto black = [&](const Json& light, const std::array<double, 3>& toLight) {
      return blackPixels(renderJson(scene, specOf(shadow, light, {"shadow", "normal"}).dump()), toLight);
    };
    EXPECT_EQ(black(soft, towards(kLowSun)), 0) << shadow;
    EXPECT_EQ(black(lamp, toLamp), 0) << shadow;
    EXPECT_EQ(black(spot, toLamp), 0) << shadow;
  }
}

TEST(Terminator, ShadingFades) {
  GlbBuilder builder;
  builder.addMeshNode(addSmoothBall(builder));
  builder.json["materials"] = {{{"pbrMetallicRoughness", {{"metallicFactor", 0}}}}};
  builder.json["meshes"][0]["primitives"][0]["material"] = 0;
  const ScenePtr scene = sceneOf(builder);
  Json light = kLowSun;
  light["intensity"] = std::numbers::pi;
  for (const Json& shadow : techniques()) {
    const Json spec = specOf(shadow, light, {"lightContribution", "normal"});
    const Frame frame = renderJson(scene, spec.dump());
    int off = 0;
    const std::size_t channels = frame.images[0].image.channels.size();
    for (std::size_t i = 0; i < floatsOf(frame, 1).size() / 3; ++i) {
      const double cosine = cosineAt(floatsOf(frame, 1), i, towards(kLowSun));
      if (cosine < 0.1) continue;
      // White and rough: nearly all of it is diffuse.
      const double lit = double{floatsOf(frame, 0)[channels * i]} / cosine;
      off += lit > 0.8 && lit < 1.3 ? 0 : 1;
    }
    EXPECT_EQ(off, 0) << shadow;
  }
}

TEST(Terminator, RaysAreRightAboutTheBall) {
  const ScenePtr scene = ball();
  for (const char* terminator : {"smooth", "flat"}) {
    const Json shadow = with({{"technique", "rayTraced"}}, terminator);
    const Frame frame = renderJson(scene, specOf(shadow, kLowSun, {"error"}).dump());
    ASSERT_TRUE(frame.report.error);
    EXPECT_EQ(frame.report.error->misclassified, 0.0) << shadow;
    EXPECT_GT(frame.report.error->receivers, 2000) << shadow;
  }
  const Frame map = renderJson(scene, specOf(Json::object(), kLowSun, {"error"}).dump());
  EXPECT_LT(map.report.error->misclassified, 0.002);
}

/// A box with flat normals on a ground without any.
ScenePtr boxOnGround() {
  GlbBuilder builder = testing::cube();
  addSheet(builder, {{-4, -1, 4}, {4, -1, 4}, {4, -1, -4}, {-4, -1, -4}});
  return sceneOf(builder);
}

TEST(Terminator, FlatMeshesStayAsTheyAreToTheBit) {
  const ScenePtr scene = boxOnGround();
  for (const Json& shadow : techniques()) {
    for (const Json& light :
         {kLowSun, Json{{"type", "point"}, {"position", {3, 4, 2}}, {"intensity", 100}, {"radius", 0.2}}}) {
      Json spec = specOf(with(shadow, "smooth"), light, {"color", "shadow"});
      spec["antialiasing"] = "msaa4x";
      const Frame smooth = renderJson(scene, spec.dump());
      spec["shadow"]["terminator"] = "flat";
      const Frame flat = renderJson(scene, spec.dump());
      EXPECT_EQ(floatsOf(smooth, 0), floatsOf(flat, 0)) << shadow << light;
      EXPECT_EQ(floatsOf(smooth, 1), floatsOf(flat, 1)) << shadow << light;
    }
  }
}

/// Pixels of the node that are more than half lit; views: shadow, ids.
int litPixels(const Frame& frame, float node) {
  int lit = 0;
  for (std::size_t i = 0; i < floatsOf(frame, 0).size(); ++i) {
    lit += floatsOf(frame, 1)[i] == node && floatsOf(frame, 0)[i] >= 0.5f ? 1 : 0;
  }
  return lit;
}

TEST(Terminator, NoLightLeaksPastASheetThatTouchesTheBall) {
  GlbBuilder builder;
  builder.addMeshNode(addSmoothBall(builder));
  // The sun stands in the east, 15 degrees high; the sheet stands upright where the ball's vertices end.
  addSheet(builder, {{1.0005f, -4, 4}, {1.0005f, -4, -4}, {1.0005f, 4, -4}, {1.0005f, 4, 4}});
  const ScenePtr scene = sceneOf(builder);
  const Json east = {{"sun", {{"azimuthDegrees", 90}, {"elevationDegrees", 15}}}};
  for (const Json& shadow : techniques()) {
    const auto lit = [&](const char* terminator) {
      return litPixels(renderJson(scene, specOf(with(shadow, terminator), east, {"shadow", "ids"}).dump()), 0);
    };
    if (shadow["technique"] != "shadowMap") {
      EXPECT_EQ(lit("smooth"), 0) << shadow;
      continue;
    }
    // Nearly along the light, the plane of a receiver passes the sheet within a texel; a disc of taps that reaches
    // beyond its tile is lit there.
    const int slack = shadow["filter"].contains("radius") ? 15 : 4;
    EXPECT_LE(lit("smooth"), lit("flat") + slack) << shadow;
  }
}

TEST(Terminator, NoShadowLeavesTheFootOfItsCaster) {
  GlbBuilder builder;
  // A hill of 8 x 8 quads, and a post on its side that the sun grazes.
  const auto place = [](double u, double v) {
    const double x = 6 * (u - 0.5), z = 6 * (v - 0.5);
    return Point{float(x), float(-0.12 * (x * x + z * z)), float(z)};
  };
  const auto normal = [](double u, double v) {
    const double x = 6 * (u - 0.5), z = 6 * (v - 0.5), up = 1 / std::sqrt(1 + 0.0576 * (x * x + z * z));
    return Point{float(0.24 * x * up), float(up), float(0.24 * z * up)};
  };
  builder.addMeshNode(addSmoothGrid(builder, 8, 8, place, normal));
  for (const float x : {-0.3f, -1.0f}) {
    addSheet(builder, {{x, -1, 0.2f}, {x, -1, -0.2f}, {x, 1, -0.2f}, {x, 1, 0.2f}});
  }
  const ScenePtr scene = sceneOf(builder);
  const Json sun = {{"sun", {{"azimuthDegrees", 90}, {"elevationDegrees", 12}}}};
  for (const Json& shadow : techniques()) {
    const auto errors = [&](const char* terminator) {
      Json spec = specOf(with(shadow, terminator), sun, {"error"});
      spec["camera"] = {{"eye", {-3, 3, 3}}, {"target", {-1, 0, 0}}, {"perspective", {{"fovYDegrees", 40}}}};
      return renderJson(scene, spec.dump()).report.error.value_or(ErrorMetrics{});
    };
    const ErrorMetrics smooth = errors("smooth"), flat = errors("flat");
    EXPECT_GT(smooth.receivers, 1000) << shadow;
    EXPECT_LE(smooth.leak, flat.leak + 0.002) << shadow;
    EXPECT_LE(smooth.acne, flat.acne + 0.002) << shadow;
    if (shadow["technique"] == "shadowMap") continue;
    EXPECT_EQ(smooth.misclassified, 0) << shadow;
  }
}

TEST(Terminator, NodesThatMirrorShearOrFlattenTurnNormalsAsTheyTurnSurfaces) {
  const double half = std::sqrt(0.5);
  const nlohmann::json nodes[] = {{{"scale", {-1, 1, 1}}},
                                  {{"scale", {1, 0.4, 0.7}}},
                                  {{"matrix", {1, 0, 0, 0, 0.6, 0.8, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}},
                                  {{"scale", {-0.5, 1, 1}}, {"rotation", {0, 0, half, half}}}};
  for (const nlohmann::json& content : nodes) {
    GlbBuilder builder;
    nlohmann::json node = content;
    node["mesh"] = addSmoothBall(builder);
    builder.addRoot(node);
    const ScenePtr scene = sceneOf(builder);
    for (const char* technique : {"shadowMap", "rayTraced"}) {
      const Json spec = specOf({{"technique", technique}}, kLowSun, {"shadow", "normal", "error"});
      const Frame frame = renderJson(scene, spec.dump());
      EXPECT_EQ(blackPixels(frame, towards(kLowSun)), 0) << content << technique;
      EXPECT_LT(frame.report.error->misclassified, 0.002) << content << technique;
    }
  }
}

} // namespace
} // namespace gnomon
