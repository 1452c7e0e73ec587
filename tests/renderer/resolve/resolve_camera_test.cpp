#include "renderer/resolve/resolve_camera.h"

#include <glm/gtc/constants.hpp>
#include <gtest/gtest.h>
#include <rapidcheck.h>

namespace gnomon {
namespace {

SceneView boxScene(const glm::dvec3& center, const glm::dvec3& half) {
  SceneView scene;
  scene.bounds = {center - half, center + half};
  return scene;
}

/// The greatest |x| or |y| that a corner of the scene has on the picture; 1 is its edge.
double reachOf(const CameraView& view, const Aabb& bounds) {
  double reach = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 sign((corner & 1) != 0 ? 1 : -1, (corner & 2) != 0 ? 1 : -1, (corner & 4) != 0 ? 1 : -1);
    const glm::dvec3 p = bounds.center() + sign * bounds.halfExtent() - view.eye;
    const double depth = glm::dot(p, view.forward);
    if (depth <= 0) return HUGE_VAL;
    const glm::dvec2 ndc = glm::abs(ndcOf(view, p));
    reach = std::max({reach, ndc.x, ndc.y});
  }
  return reach;
}

TEST(ResolveCamera, AnOrbitWithoutADistanceFramesTheWholeScene) {
  EXPECT_TRUE(rc::check([] {
    const auto value = [](int low, int high) { return *rc::gen::inRange(low, high) / 100.0; };
    const SceneView scene = boxScene({value(-9999, 9999), value(-9999, 9999), value(-9999, 9999)},
                                     {value(1, 9999), value(1, 9999), value(1, 9999)});
    Camera camera;
    camera.orbit = Orbit{};
    camera.orbit->azimuthDegrees = value(-36000, 36000);
    camera.orbit->elevationDegrees = value(-9000, 9001);
    camera.perspective = Perspective{value(500, 15000), {}, {}};
    const auto resolved = resolveCamera(camera, scene, {*rc::gen::inRange(200, 5001), 1000});
    RC_ASSERT(static_cast<bool>(resolved));
    const double reach = reachOf(resolved->view, scene.bounds);
    RC_ASSERT(reach <= 1.0);
    // And no farther away than that takes, but for a thousandth of the scene before its nearest point.
    const double room = glm::length(scene.bounds.halfExtent()) * 1e-3;
    const glm::dvec3 nearest = farthestOf(scene.bounds)(-resolved->view.forward) - resolved->view.eye;
    RC_ASSERT(reach > 0.9 || glm::dot(nearest, resolved->view.forward) < room * 1.001);
  }));
}

TEST(ResolveCamera, AxesAreOrthonormalEvenStraightAboveAndBelow) {
  for (const double elevation : {-90.0, -89.9999, 0.0, 45.0, 89.9999999, 90.0}) {
    Camera camera;
    camera.orbit = Orbit{};
    camera.orbit->elevationDegrees = elevation;
    const CameraView view = resolveCamera(camera, boxScene({1, 2, 3}, {1, 1, 1}), {96, 64})->view;
    const glm::dmat3 axes(view.right, view.up, view.forward);
    const glm::dmat3 unit = glm::transpose(axes) * axes;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) EXPECT_NEAR(unit[i][j], i == j ? 1 : 0, 1e-9) << elevation;
    }
  }
}

TEST(ResolveCamera, AzimuthIsClockwiseFromNorth) {
  Camera camera;
  camera.orbit = Orbit{Vec3{0, 0, 0}, 90, 0, 5};
  const CameraView east = resolveCamera(camera, {}, {64, 64})->view;
  EXPECT_LT(glm::length(east.eye - glm::dvec3(5, 0, 0)), 1e-12);
  camera.orbit->azimuthDegrees = 0;
  const CameraView north = resolveCamera(camera, {}, {64, 64})->view;
  EXPECT_LT(glm::length(north.eye - glm::dvec3(0, 0, -5)), 1e-12);
}

TEST(ResolveCamera, ResolvingTwiceChangesNothing) {
  SceneView scene = boxScene({1e6, 3, -7}, {4, 5, 6});
  scene.cameras.push_back(
      {7, "tower", {1e6, 9, 9}, glm::normalize(glm::dvec3(1, -2, -3)), {0, 1, 0}, Perspective{}, {}});
  scene.cameras.back().up =
      glm::normalize(glm::cross(glm::cross(scene.cameras[0].forward, {0, 1, 0}), scene.cameras[0].forward));
  Camera byName;
  byName.node = "tower";
  for (const Camera& camera : {Camera{}, byName}) {
    const auto once = resolveCamera(camera, scene, {96, 64});
    const auto twice = resolveCamera(once->camera, scene, {96, 64});
    EXPECT_TRUE(once->camera == twice->camera);
    EXPECT_EQ(once->view.forward, twice->view.forward);
    EXPECT_EQ(once->view.right, twice->view.right);
    EXPECT_EQ(once->view.near, twice->view.near);
  }
}

TEST(ResolveCamera, G5_OrthographicCamerasKeepTheirBoxWhateverTheAspect) {
  Camera camera;
  camera.orthographic = Orthographic{6, -10, 50};
  const CameraView view = resolveCamera(camera, boxScene({0, 0, 0}, {1, 1, 1}), {128, 64})->view;
  EXPECT_FALSE(view.perspective);
  EXPECT_EQ(view.halfSize, glm::dvec2(6, 3));
  EXPECT_EQ(view.near, -10);
  EXPECT_EQ(view.far, 50);
}

TEST(ResolveCamera, AnUnknownNodeIsToldWithThoseThereAre) {
  SceneView scene;
  scene.cameras.push_back({3, "a", {}, {0, 0, -1}, {0, 1, 0}, Perspective{}, {}});
  scene.cameras.push_back({7, "", {}, {0, 0, -1}, {0, 1, 0}, Perspective{}, {}});
  Camera camera;
  camera.node = 4;
  const auto refused = resolveCamera(camera, scene, {64, 64});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.problems()[0].limit, "one of 0 = a (node:3), 1 (node:7)");
  EXPECT_EQ(refused.problems()[0].actual, "4");
  const auto none = resolveCamera(camera, SceneView(), {64, 64});
  EXPECT_EQ(none.problems()[0].limit, "the scene has no cameras");
}

TEST(ResolveCamera, ACameraHasANameOrAnIndexOrANode) {
  SceneView scene;
  const auto add = [&](int node, const char* name) {
    scene.cameras.push_back({node, name, {double(node), 0, 0}, {0, 0, -1}, {0, 1, 0}, Perspective{}, {}});
  };
  add(5, "front");
  add(0, "side");
  add(9, "0"); // its name comes before the index of another
  add(1, "node:0");
  const auto nodeOf = [&](std::variant<int, std::string> asked) {
    Camera camera;
    camera.node = std::move(asked);
    const auto resolved = resolveCamera(camera, scene, {64, 64});
    return resolved ? static_cast<int>(resolved->view.eye.x) : -1;
  };
  EXPECT_EQ(nodeOf("front"), 5);
  EXPECT_EQ(nodeOf("side"), 0);
  EXPECT_EQ(nodeOf("0"), 9);
  EXPECT_EQ(nodeOf(0), 9);
  EXPECT_EQ(nodeOf(1), 0);
  EXPECT_EQ(nodeOf("1"), 0);
  EXPECT_EQ(nodeOf("node:0"), 1); // again a name
  EXPECT_EQ(nodeOf("node:5"), 5);
  for (const char* asked : {"4", "-1", "node:4", "node:", "node:x", "", "Front", "99999999999999999999"}) {
    EXPECT_EQ(nodeOf(asked), -1) << asked;
  }
}

} // namespace
} // namespace gnomon
