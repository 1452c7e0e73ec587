// Shadows of volumes on surfaces, where the light passes along a face of the box, or beside it.
#include <cmath>
#include <glm/trigonometric.hpp>

#include "tests/renderer/frame_fixture.h"
#include "tests/renderer/made_grids.h"

namespace gnomon {
namespace {

using testing::renderJson;
using testing::valueAt;

constexpr double kSigma = 0.02; // per metre

/// A ground of 100 m, and a wall at x = 30 that faces -x.
ScenePtr wallScene() {
  testing::GlbBuilder builder = testing::plane();
  builder.json["nodes"][0]["scale"] = {50, 1, 50};
  const double half = std::sqrt(0.5);
  builder.addRoot({{"mesh", 0}, {"scale", {25, 1, 25}}, {"translation", {30, 0, 0}}, {"rotation", {0, 0, half, half}}});
  SceneBundle bundle = builder.bundle();
  bundle.files["solid.npy"] = testing::byteGrid(5, 5, 5, [](int, int, int) { return 255; });
  return testing::sceneOf(bundle);
}

/// The shadow on what a camera sees whose picture is `side` metres high.
Frame shadowOf(const ScenePtr& scene, const Json& place, const Json& camera, double side, const Json& direction) {
  Json volume{{"file", "solid.npy"},
              {"transferFunction", {{{"value", 0}, {"extinction", 0}}, {{"value", 255}, {"extinction", kSigma}}}}};
  volume.update(place);
  Json spec{{"width", 240},           {"height", 240},
            {"camera", camera},       {"lights", {{{"type", "directional"}, {"direction", direction}}}},
            {"antialiasing", "none"}, {"volumes", Json::array({volume})},
            {"views", {"shadow"}},    {"output", {{"format", "exr"}, {"exrPixelType", "float"}}}};
  spec["camera"]["orthographic"] = {{"height", side}};
  return renderJson(scene, spec.dump());
}

/// Up to a height of 30 m, with y = 0 at the lower edge.
Frame wallShadow(const ScenePtr& scene, const Json& place, const Json& direction) {
  return shadowOf(scene, place, {{"eye", {22, 15, 0}}, {"target", {30, 15, 0}}}, 30, direction);
}

/// The ground from above, x and z from -40 to 40.
Frame groundShadow(const ScenePtr& scene, const Json& place, const Json& direction) {
  const Json camera{{"eye", {0, 40, 0}}, {"target", {0, 0, 0}}, {"up", {0, 0, -1}}};
  return shadowOf(scene, place, camera, 80, direction);
}

double onWall(const Frame& frame, double y) {
  return double{valueAt(frame, 0.5, 1 - y / 30)};
}

double onGround(const Frame& frame, double x) {
  return double{valueAt(frame, (x + 40) / 80, 0.5)};
}

TEST(VolumeLightWays, D6_D7_LightAlongTheFacesOfABoxIsTakenBetweenThemAlone) {
  const ScenePtr scene = wallScene();
  const Json box{{"box", {{"min", {-20, 4, -20}}, {"max", {20, 6, 20}}}}};
  const double taken = std::exp(-kSigma * 40);
  for (const double tilt : {0.0, 1e-12, -1e-9, 1e-6, -1e-5}) {
    const Frame frame = wallShadow(scene, box, {1, tilt, 0});
    for (const double y : {4.2, 5.0, 5.8}) EXPECT_NEAR(onWall(frame, y), taken, 0.003) << tilt << ' ' << y;
    for (const double y : {3.8, 6.2, 20.0}) EXPECT_NEAR(onWall(frame, y), 1, 1e-6) << tilt << ' ' << y;
  }
}

TEST(VolumeLightWays, D6_D7_LightAlongTheFacesOfATurnedBoxIsTakenBetweenThemAlone) {
  const ScenePtr scene = wallScene();
  const double c = std::cos(glm::radians(30.0)), s = 0.5;
  // 40 m along the light, 2 m thick, around -10, 15, 0.
  const glm::dvec3 along(40 * c, -40 * s, 0), across(2 * s, 2 * c, 0),
      corner = glm::dvec3(-10, 15, -20) - 0.5 * (along + across);
  const Json place{
      {"matrix", {along.x, along.y, 0, 0, across.x, across.y, 0, 0, 0, 0, 40, 0, corner.x, corner.y, corner.z, 1}}};
  const Frame frame = groundShadow(scene, place, {c, -s, 0});
  const double middle = -10 + 15 / s * c, half = 1 / s;
  for (const double x : {-0.8, 0.0, 0.8})
    EXPECT_NEAR(onGround(frame, middle + x * half), std::exp(-kSigma * 40), 0.003);
  for (const double x : {-6.0, -1.3, 1.3, 3.0}) EXPECT_NEAR(onGround(frame, middle + x * half), 1, 1e-6) << x;
}

TEST(VolumeLightWays, D6_D7_LightThatPassesBesideTheBoxIsNotTaken) {
  const ScenePtr scene = wallScene();
  const Json box{{"box", {{"min", {-35, 30, -5}}, {"max", {-25, 32, 5}}}}};
  const Frame slanting = groundShadow(scene, box, {1, -1, 0});
  EXPECT_NEAR(onGround(slanting, 1), std::exp(-kSigma * 2 * std::sqrt(2.0)), 0.003);
  for (const double x : {-30.0, -6.0, 8.0, 20.0}) EXPECT_NEAR(onGround(slanting, x), 1, 1e-6) << x;
  const Frame other = groundShadow(scene, box, {-1, -1, 0});
  for (const double x : {-39.0, -30.0, -6.0, 0.0}) EXPECT_NEAR(onGround(other, x), 1, 1e-6) << x;
  EXPECT_NEAR(onWall(wallShadow(scene, box, {1, 0, 0}), 20), 1, 1e-6) << "below it";
}

} // namespace
} // namespace gnomon
